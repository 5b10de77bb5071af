#include "kinegraph/scene/tree/scene_bytes.h"

#include <any>
#include <bit>
#include <cstring>
#include <map>
#include <type_traits>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/scene/tree/tree_edits.h"

namespace kinegraph::inline scene_internal {

namespace {

static_assert(std::endian::native == std::endian::little, "scenes are written little-endian");

constexpr char kMark[] = "kinegraph scene 2\n";

/// Appends values. Archives call `archive(value)`; the functions below describe each type once, for writing and
/// reading.
class Writer {
 public:
  static constexpr bool reading = false;
  std::string bytes = kMark;

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(T)); }
  void size(std::size_t n) { (*this)(std::uint64_t(n)); }
  void raw(const void* data, std::size_t n) { bytes.append(static_cast<const char*>(data), n); }

  /// Shared objects are written at their first occurrence. Returns whether this is the first.
  bool shared(const void* object) {
    const auto [place, is_new] = known_.try_emplace(object, known_.size());
    size(place->second);
    return is_new;
  }

 private:
  std::map<const void*, std::uint64_t> known_ = {{nullptr, 0}};
};

class Reader {
 public:
  static constexpr bool reading = true;
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& value) { raw(&value, sizeof(T)); }
  void raw(void* data, std::size_t n) {
    if (n > bytes_.size()) throw ValueError("the bytes of the scene end too early");
    if (n > 0) std::memcpy(data, bytes_.data(), n);
    bytes_.remove_prefix(n);
  }

  /// Reads a count of items of at least `least` bytes each.
  std::size_t size(std::size_t least = 1) {
    std::uint64_t n = 0;
    (*this)(n);
    if (n > bytes_.size() / least) throw ValueError("the bytes of the scene are damaged: a count is too large");
    return std::size_t(n);
  }
  std::uint64_t number() {
    std::uint64_t n = 0;
    (*this)(n);
    return n;
  }
  bool done() const { return bytes_.empty(); }

  /// The shared object of that number, or the place to store it.
  std::any* known(std::uint64_t number) {
    if (number > known_.size()) throw ValueError("the bytes of the scene are damaged: a reference is out of range");
    if (number == known_.size()) known_.emplace_back();
    return &known_[number];
  }

 private:
  std::string_view bytes_;
  std::vector<std::any> known_ = {std::any()};  ///< number 0 is null
};

template <class A, class T>
void items(A& archive, T& values) {  // vectors of plain numbers, or of arrays of them
  using Item = typename T::value_type;
  static_assert(
      std::is_trivially_destructible_v<Item>);  // Eigen's fixed vectors are plain numbers but not trivially copyable
  if constexpr (A::reading) {
    values.resize(archive.size(sizeof(Item)));
  } else {
    archive.size(values.size());
  }
  archive.raw(values.data(), values.size() * sizeof(Item));
}

template <class A>
void text(A& archive, std::string& value) {
  items(archive, value);
}

template <class A>
void numbers(A& archive, VectorXd& value) {
  if constexpr (A::reading) {
    value.resize(Eigen::Index(archive.size(8)));
  } else {
    archive.size(std::size_t(value.size()));
  }
  archive.raw(value.data(), std::size_t(value.size()) * 8);
}

template <class A, class Derived>
void fixed(A& archive, Eigen::PlainObjectBase<Derived>& value) {
  archive.raw(value.data(), std::size_t(value.size()) * sizeof(double));
}

template <class A, class T, class Each>
void list(A& archive, std::vector<T>& values, Each each) {
  if constexpr (A::reading) {
    values.resize(archive.size());
  } else {
    archive.size(values.size());
  }
  for (T& value : values) each(value);
}

template <class A, class T, class Each>
void optional(A& archive, std::optional<T>& value, Each each) {
  bool there = value.has_value();
  archive(there);
  if (!there) return value.reset();
  if (!value) value.emplace();
  each(*value);
}

/// A pointer to an object that may have several owners.
template <class T, class A, class Each>
void sharedObject(A& archive, std::shared_ptr<T>& pointer, Each each) {
  using Plain = std::remove_const_t<T>;
  if constexpr (A::reading) {
    const std::uint64_t number = archive.number();
    pointer.reset();
    if (number == 0) return;
    if (std::any* known = archive.known(number); !known->has_value()) {
      auto object = std::make_shared<Plain>();
      *known = object;
      each(*object);
      pointer = object;
    } else if (const auto* object = std::any_cast<std::shared_ptr<Plain>>(known)) {
      pointer = *object;
    } else {
      throw ValueError("the bytes of the scene are damaged: a reference has the wrong type");
    }
  } else if (archive.shared(pointer.get())) {
    each(const_cast<Plain&>(*pointer));
  }
}

template <class A>
void pose(A& archive, Pose& X) {
  fixed(archive, X.p);
  fixed(archive, X.q.coeffs());
}

template <class A>
void graph(A& archive, Graph& value);

template <class A>
void position(A& archive, SourcePosition& where) {
  text(archive, where.file);
  archive(where.line);
  archive(where.column);
}

template <class Variant, std::size_t... I>
void makeAlternative(Variant& variant, std::size_t index, std::index_sequence<I...>) {
  ((index == I ? void(variant.template emplace<I>()) : void()), ...);
}

template <class A>
void value(A& archive, Value& v) {
  constexpr std::size_t kCount = std::variant_size_v<decltype(v.data)>;
  auto index = std::uint8_t(v.data.index());
  archive(index);
  if constexpr (A::reading) {
    if (index >= kCount) throw ValueError("the bytes of the scene are damaged: an attribute has an unknown type");
    makeAlternative(v.data, index, std::make_index_sequence<kCount>());
  }
  position(archive, v.where);
  std::visit(
      [&](auto& data) {
        using T = std::decay_t<decltype(data)>;
        const auto word = [&](std::string& w) { text(archive, w); };
        if constexpr (std::is_arithmetic_v<T>) {
          archive(data);
        } else if constexpr (std::is_same_v<T, std::string>) {
          word(data);
        } else if constexpr (std::is_same_v<T, NumberArray>) {
          items(archive, data.numbers);
          archive(data.rows);
        } else if constexpr (std::is_same_v<T, StringArray>) {
          list(archive, data, word);
        } else if constexpr (std::is_same_v<T, ValueList>) {
          list(archive, data, [&](Value& item) { value(archive, item); });
        } else if constexpr (std::is_same_v<T, AngleText>) {
          word(data.text);
        } else if constexpr (std::is_same_v<T, NameTuple>) {
          list(archive, data.names, word);
        } else {
          graph(archive, data);
        }
      },
      v.data);
}

template <class A>
void graph(A& archive, Graph& g) {
  list(archive, g.nodes, [&](Node& node) {
    const auto word = [&](std::string& w) { text(archive, w); };
    word(node.key);
    list(archive, node.tags, word);
    list(archive, node.parents, word);
    value(archive, node.value);
    position(archive, node.where);
  });
}

template <class A>
void image(A& archive, Image& i) {
  text(archive, i.bytes);
  text(archive, i.path);
}

template <class A>
void mesh(A& archive, Mesh& m) {
  items(archive, m.vertices);
  items(archive, m.triangles);
  items(archive, m.colors);
  items(archive, m.parts);
  items(archive, m.texcoords);
  list(archive, m.textures, [&](TexturedTriangles& t) {
    archive(t.first);
    archive(t.count);
    sharedObject(archive, t.image, [&](Image& i) { image(archive, i); });
  });
  if constexpr (A::reading) {
    for (const auto& triangle : m.triangles) {
      for (std::uint32_t v : triangle) {
        if (v >= m.vertices.size())
          throw ValueError("the bytes of the scene are damaged: a triangle refers to a missing vertex");
      }
    }
    std::size_t end = 0;
    for (const TexturedTriangles& t : m.textures) {
      const bool good =
          t.image && t.first >= end && t.count <= m.triangles.size() && t.first <= m.triangles.size() - t.count;
      if (!good || m.texcoords.size() != m.vertices.size())
        throw ValueError("the bytes of the scene are damaged: a texture has no triangles");
      end = t.first + t.count;
    }
  }
}

template <class A>
void geometry(A& archive, Geometry& g) {
  int type = int(g.type);
  archive(type);
  items(archive, g.size);
  sharedObject(archive, g.mesh, [&](Mesh& m) { mesh(archive, m); });
  text(archive, g.mesh_file);
  fixed(archive, g.mesh_scale);
  sharedObject(archive, g.grid, [&](Grid& grid) {
    archive.raw(grid.cells.data(), sizeof(grid.cells));
    items(archive, grid.values);
  });
  if constexpr (A::reading) {
    g.type = ShapeType(type);
    if (g.type != ShapeType::none) shapeTypeName(g.type);  // throws for invalid numbers
  }
}

template <class A>
void shape(A& archive, Shape& s) {
  sharedObject(archive, s.geometry, [&](Geometry& g) { geometry(archive, g); });
  optional(archive, s.color, [&](Vector4d& color) { fixed(archive, color); });
  archive(s.contact);
  text(archive, s.visual_mesh);
  pose(archive, s.visual_pose);
  sharedObject(archive, s.texture, [&](Image& i) { image(archive, i); });
  archive(s.texture_repeat[0]);
  archive(s.texture_repeat[1]);
}

/// All fields of a joint except `mimic`.
template <class A>
void joint(A& archive, Joint& j) {
  int type = int(j.type);
  std::string code = j.code;
  archive(type);
  text(archive, code);
  if constexpr (A::reading) j = Joint(JointType(type), code);
  fixed(archive, j.axis);
  archive(j.scale);
  for (VectorXd* v : {&j.q, &j.home, &j.lower, &j.upper}) numbers(archive, *v);
  archive(j.control_weight);
  archive(j.active);
  archive(j.stable);
  archive(j.sample_uniform);
  archive(j.sample_deviation);
}

template <class A>
void frame(A& archive, FrameData& f) {
  text(archive, f.name);
  pose(archive, f.pose);
  optional(archive, f.joint, [&](Joint& j) { joint(archive, j); });
  sharedObject(archive, f.shape, [&](Shape& s) { shape(archive, s); });
  optional(archive, f.inertia, [&](Inertia& inertia) {
    archive(inertia.mass);
    fixed(archive, inertia.com);
    fixed(archive, inertia.matrix);
  });
  if constexpr (A::reading) {
    graph(archive, f.attributes.edit());
  } else {
    graph(archive, const_cast<Graph&>(*f.attributes));  // writing only reads it
  }
}

}  // namespace

std::string sceneToBytes(const SceneTree& scene) {
  Writer archive;
  archive.size(scene.frames().size());
  for (const auto& data : scene.frames()) frame(archive, *data);
  const auto id = [](const FrameData* frame) { return std::int64_t(frame ? frame->id : -1); };
  for (const auto& data : scene.frames()) {
    archive(id(data->parent));
    archive(id(data->joint ? data->joint->mimic : nullptr));
    for (const std::vector<FrameData*>* others : {&data->children, &data->no_contact}) {
      std::vector<std::int64_t> ids;
      for (const FrameData* other : *others) ids.push_back(id(other));
      items(archive, ids);
    }
  }
  return std::move(archive.bytes);
}

std::shared_ptr<SceneTree> sceneFromBytes(std::string_view bytes) {
  constexpr std::size_t kMarkSize = sizeof(kMark) - 1;
  if (bytes.substr(0, kMarkSize) != std::string_view(kMark, kMarkSize)) {
    throw ValueError("the bytes are not a scene of this version of kinegraph");
  }
  Reader archive(bytes.substr(kMarkSize));
  auto scene = std::make_shared<SceneTree>();
  const std::size_t count = archive.size();
  for (std::size_t i = 0; i < count; ++i) {
    FrameData& data = scene->add("", nullptr);
    frame(archive, data);
    if (data.shape && data.shape->revision == 0) scene->looksChanged(*data.shape);
  }
  const auto read = [&]() -> FrameData* {
    std::int64_t id = -1;
    archive(id);
    if (id >= std::int64_t(count)) throw ValueError("the bytes of the scene are damaged: a frame id is out of range");
    return id < 0 ? nullptr : scene->frames()[std::size_t(id)].get();
  };
  for (std::size_t i = 0; i < count; ++i) {
    FrameData& data = *scene->frames()[i];
    data.parent = read();
    FrameData* mimic = read();
    if (data.joint) data.joint->mimic = mimic;
    for (std::vector<FrameData*>* others : {&data.children, &data.no_contact}) {
      std::vector<std::int64_t> ids;
      items(archive, ids);
      for (std::int64_t id : ids) {
        if (id < 0 || id >= std::int64_t(count))
          throw ValueError("the bytes of the scene are damaged: a frame id is out of range");
        others->push_back(scene->frames()[std::size_t(id)].get());
      }
    }
  }
  if (!archive.done()) throw ValueError("the bytes of the scene are damaged: extra bytes at the end");
  try {
    checkConsistency(*scene);
  } catch (const Error& error) {
    throw ValueError(cat("the bytes of the scene are damaged: ", error.what()));
  }
  scene->structureChanged();
  return scene;
}

}  // namespace kinegraph::inline scene_internal
