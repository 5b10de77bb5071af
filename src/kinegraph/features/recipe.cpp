#include "kinegraph/features/recipe.h"

#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/contact_motion.h"
#include "kinegraph/features/orientation.h"

namespace kinegraph::inline features_internal {

namespace {

using Ids = std::vector<int>;
using Made = std::unique_ptr<Feature>;

struct Maker {
  Made (*make)(const FeatureRecipe& recipe, const Ids& frames);
  int frames;  ///< number of frames; 0 for features of a force, which take its frames
};

template <class T>
Made ofForce(const FeatureRecipe& recipe, const Ids&) {
  return std::make_unique<T>(*recipe.contact);
}

template <class T>
Made ofForceAndParameter(const FeatureRecipe& recipe, const Ids&) {
  return std::make_unique<T>(*recipe.contact, recipe.parameter);
}

Made alongNormal(const FeatureRecipe& recipe, const Ids&) {
  const ContactForce& contact = *recipe.contact;
  return std::make_unique<TangentialForce>(contact.object, contact.from, std::vector<ContactForce>{contact});
}

Made axisDifference(const FeatureRecipe& recipe, const Ids& f) {
  return std::make_unique<AxisDifference>(f[0], f[1], int(recipe.parameter));
}
Made normalAlignment(const FeatureRecipe& recipe, const Ids& f) {
  return std::make_unique<NormalAlignment>(f[0], f[1], recipe.parameter);
}
Made pushRadius(const FeatureRecipe& recipe, const Ids& f) {
  return std::make_unique<PushRadius>(f[0], f[1], recipe.parameter);
}
Made normalsOppose(const FeatureRecipe&, const Ids& f) { return std::make_unique<NormalsOppose>(f[0], f[1], f[2]); }

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> all = {{"axisDifference", {axisDifference, 2}},
                                                   {"elasticBounce", {ofForceAndParameter<ElasticBounce>, 0}},
                                                   {"force", {ofForce<ForceValue>, 0}},
                                                   {"forceAlongNormal", {alongNormal, 0}},
                                                   {"forceTimesDistance", {ofForce<ForceTimesDistance>, 0}},
                                                   {"forceTimesVelocity", {ofForce<ForceTimesVelocity>, 0}},
                                                   {"frictionCone", {ofForceAndParameter<FrictionCone>, 0}},
                                                   {"pairNormalAlign", {normalAlignment, 2}},
                                                   {"pairNormalsOppose", {normalsOppose, 3}},
                                                   {"pullingForce", {ofForce<PullingForce>, 0}},
                                                   {"pushRadius", {pushRadius, 2}},
                                                   {"slidingVelocity", {ofForce<SlidingVelocity>, 0}}};
  return all;
}

}  // namespace

const std::vector<std::string>& recipeNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, maker] : makers()) list.push_back(name);
    return list;
  }();
  return names;
}

Made makeFeature(const FeatureRecipe& recipe, const Ids& frames) {
  const auto place = makers().find(recipe.name);
  if (place == makers().end()) {
    throw NameError(cat("there is no feature '", recipe.name, "'", similarHint(recipe.name, recipeNames()),
                        "; there are ", join(recipeNames())));
  }
  const Maker& maker = place->second;
  if (maker.frames == 0 && !recipe.contact)
    throw ValueError(cat("feature ", recipe.name, " needs a contact force; none was given"));
  if (maker.frames > 0 && maker.frames != int(frames.size())) {
    throw ValueError(cat("feature ", recipe.name, " takes ", maker.frames, " frames, got ", frames.size()));
  }
  return maker.make(recipe, frames);
}

}  // namespace kinegraph::inline features_internal
