import * as THREE from "three";
import { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import { Cloud, linearColors, spread } from "./clouds";
import { label } from "./labels";
import type { LoggedImages } from "./logged";
import { WideLines } from "./lines";
import type { DrawMessage } from "./messages";
import { marker } from "./shapes";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

/** Coordinates, colors and pixels of a drawing. */
interface Data {
  points: Float32Array<ArrayBuffer>;
  colors: Uint8Array<ArrayBuffer>;
  columns: number;
  rows: number;
  rgb: Uint8Array<ArrayBuffer>;
}

interface Drawing {
  message: DrawMessage;
  group: THREE.Group;
  frame: number | null; // id of the frame; null: not looked up yet
}

const RANK = 2; // of labels: above the names of frames
const SQUARE = 4; // pixels: points without a size

function readData(data: ArrayBuffer): Data {
  const view = new DataView(data);
  const [points, colors, columns, rows] = [4, 8, 12, 16].map((at) => view.getUint32(at, true)) as [number, number, number, number];
  return {
    points: new Float32Array(data, 20, 3 * points),
    colors: new Uint8Array(data, 20 + 12 * points, 4 * colors),
    columns,
    rows,
    rgb: new Uint8Array(data, 20 + 12 * points + 4 * colors),
  };
}

const colorAt = (colors: Uint8Array, i: number): THREE.Color =>
  new THREE.Color().setRGB(colors[4 * i]! / 255, colors[4 * i + 1]! / 255, colors[4 * i + 2]! / 255, THREE.SRGBColorSpace);

/** A geometry with the points at these indices, and their colors if each point has one. */
function geometryOf(data: Data, indices: number[]): THREE.BufferGeometry {
  const pick = (from: Float32Array): Float32Array<ArrayBuffer> => Float32Array.from(indices.flatMap((i) => [from[3 * i]!, from[3 * i + 1]!, from[3 * i + 2]!]));
  const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(pick(data.points), 3));
  if (data.colors.length > 4) geometry.setAttribute("color", new THREE.BufferAttribute(pick(linearColors(data.colors)), 3));
  return geometry;
}

function lineOf(data: Data, indices: number[], width: number): THREE.Object3D {
  return new WideLines(geometryOf(data, indices), colorAt(data.colors, 0), data.colors[3]! / 255, width);
}

function arrowOf({ size }: DrawMessage, { points, colors }: Data): THREE.Object3D {
  const from = new THREE.Vector3(points[0], points[1], points[2]), along = new THREE.Vector3(points[3], points[4], points[5]);
  const length = along.length();
  const group = new THREE.Group();
  if (length === 0) return group;
  const head = Math.min(0.4 * length, 4 * size);
  const opacity = colors[3]! / 255;
  const material = new THREE.MeshStandardMaterial({ color: colorAt(colors, 0), roughness: 0.7, opacity, transparent: opacity < 1 });
  group.add(
    new THREE.Mesh(new THREE.CylinderGeometry(size / 2, size / 2, length - head, 16).translate(0, (length - head) / 2, 0), material),
    new THREE.Mesh(new THREE.ConeGeometry(1.2 * size, head, 24).translate(0, length - head / 2, 0), material),
  );
  for (const part of group.children) part.castShadow = true;
  group.position.copy(from);
  group.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.divideScalar(length));
  return group;
}

function cloudOf(message: DrawMessage, data: Data, stage: Stage): THREE.Object3D {
  const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(data.points, 3));
  const own = data.colors.length > 4;
  if (own) geometry.setAttribute("color", new THREE.BufferAttribute(linearColors(data.colors), 3));
  const material = new THREE.PointsMaterial({ color: own ? 0xffffff : colorAt(data.colors, 0), vertexColors: own, size: SQUARE, sizeAttenuation: false });
  const cloud = new Cloud(spread(geometry), material);
  if (message.size === 0) return cloud;
  cloud.onBeforeRender = (renderer, _scene, camera) => {
    const zoom = camera.projectionMatrix.elements[5]!; // heights of half the picture per m (at 1 m)
    const perspective = camera instanceof THREE.PerspectiveCamera;
    if (material.sizeAttenuation !== perspective) {
      material.sizeAttenuation = perspective;
      material.needsUpdate = true;
      stage.redraw();
    }
    material.size = message.size * zoom * (perspective ? 1 : renderer.domElement.clientHeight / 2);
  };
  return cloud;
}

/** A picture of a width and height at a distance: x to the right, y down. */
function pictureOf({ columns, rows, rgb }: Data, width: number, height: number, z: number): THREE.Object3D {
  const pixels = new Uint8Array(4 * columns * rows).fill(255);
  for (let i = 0; i < columns * rows; ++i) for (let k = 0; k < 3; ++k) pixels[4 * i + k] = rgb[3 * i + k]!;
  const texture = new THREE.DataTexture(pixels, columns, rows);
  Object.assign(texture, { colorSpace: THREE.SRGBColorSpace, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, needsUpdate: true });
  const plane = new THREE.PlaneGeometry(width, height);
  const places = plane.getAttribute("uv"); // row 0 is at the side of y < 0
  for (let i = 0; i < places.count; ++i) places.setY(i, plane.getAttribute("position").getY(i) > 0 ? 1 : 0);
  return new THREE.Mesh(plane.translate(0, 0, z), new THREE.MeshBasicMaterial({ map: texture, side: THREE.DoubleSide, toneMapped: false }));
}

function frustumOf(message: DrawMessage, data: Data): THREE.Object3D {
  const { size: z, focal, aspect } = message;
  const y = (0.5 * z) / focal, x = y * aspect;
  const corners = [[-x, -y, z], [x, -y, z], [x, y, z], [-x, y, z]].flat();
  const up = [-0.3 * x, -1.1 * y, z, 0.3 * x, -1.1 * y, z, 0, -1.4 * y, z];
  const outline = { ...data, points: Float32Array.from([0, 0, 0, ...corners, ...up]) };
  const edges = [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 5];
  const group = new THREE.Group().add(lineOf(outline, edges, message.width));
  return data.rgb.length > 0 ? group.add(pictureOf(data, 2 * x, 2 * y, z)) : group;
}

/** What the program draws into the scene, by name. */
export class Drawings {
  private readonly drawn = new Map<string, Drawing>();
  private readonly group = new THREE.Group();
  private announced: DrawMessage | null = null; // its data have not arrived yet

  constructor(
    private readonly stage: Stage,
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly images: LoggedImages,
  ) {
    stage.scene.add(this.group);
    stage.onDraw(() => this.follow());
    stage.onDraw(() => this.group.traverse((object) => object instanceof Cloud && object.thin(stage.hurries)));
  }

  get names(): string[] {
    return [...this.drawn.keys()];
  }

  clear(): void {
    for (const name of [...this.names, ...this.images.names]) this.remove(name);
  }

  announce(message: DrawMessage): void {
    this.announced = message;
  }

  readData(data: ArrayBuffer): void {
    if (!this.announced) return;
    const message = this.announced;
    this.announced = null;
    const content = readData(data);
    if (message.type === "log") {
      this.undraw(message.name);
      this.images.show(message.name, content.columns, content.rows, content.rgb);
      return;
    }
    this.remove(message.name);
    const drawing = { message, group: this.make(message, content), frame: null };
    this.drawn.set(message.name, drawing);
    this.group.add(drawing.group);
    this.stage.redraw();
  }

  remove(name: string): void {
    this.images.remove(name);
    this.undraw(name);
  }

  private undraw(name: string): void {
    const drawing = this.drawn.get(name);
    if (!drawing) return;
    drawing.group.traverse((object) => {
      if (object instanceof CSS2DObject) object.element.remove();
      const { geometry, material } = object as THREE.Mesh;
      geometry?.dispose();
      if (material && !Array.isArray(material)) {
        (material as THREE.MeshBasicMaterial).map?.dispose();
        material.dispose();
      }
    });
    this.group.remove(drawing.group);
    this.drawn.delete(name);
    this.stage.redraw();
  }

  /** Call when frames have been added, removed or renamed. */
  refresh(): void {
    for (const drawing of this.drawn.values()) drawing.frame = null;
  }

  private make(message: DrawMessage, data: Data): THREE.Group {
    const count = data.points.length / 3;
    const outer = new THREE.Group(), inner = new THREE.Group();
    const [x, y, z, qw, qx, qy, qz] = message.pose as [number, number, number, number, number, number, number];
    inner.position.set(x, y, z);
    inner.quaternion.set(qx, qy, qz, qw);
    outer.add(inner);
    if (message.type === "line") inner.add(lineOf(data, Array.from({ length: Math.max(0, count - 1) }, (_, i) => [i, i + 1]).flat(), message.width));
    else if (message.type === "arrow") inner.add(arrowOf(message, data));
    else if (message.type === "points") inner.add(cloudOf(message, data, this.stage));
    else if (message.type === "axes") inner.add(marker(message.size));
    else if (message.type === "frustum") inner.add(frustumOf(message, data));
    else if (message.type === "image") inner.add(pictureOf(data, message.size, message.size / message.aspect, 0));
    if (message.text !== "") {
      const text = label(message.text, RANK, "name drawn");
      if (count > 0) text.position.fromArray(data.points);
      if (message.type === "arrow") text.position.add(new THREE.Vector3().fromArray(data.points, 3));
      inner.add(text);
    }
    return outer;
  }

  /** Puts the drawings of frames where these are; hides those whose frame does not exist. */
  private follow(): void {
    for (const drawing of this.drawn.values()) {
      const { group, message } = drawing;
      if (message.frame === "") continue;
      if (drawing.frame === null) {
        for (const [id, shown] of this.frames) if (shown.message.name === message.frame) drawing.frame = id;
      }
      const anchor = drawing.frame === null ? undefined : this.frames.get(drawing.frame)?.anchor;
      group.visible = anchor !== undefined;
      if (!anchor) continue;
      group.position.copy(anchor.position);
      group.quaternion.copy(anchor.quaternion);
    }
  }
}
