import * as THREE from "three";
import { WideLines } from "./lines";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

const WIDTH = 2.5; // pixels
const DIRECTIONS = 8;
const ORDER = 900; // drawn behind everything else, over everything
const EDGE_SHADER = {
  vertexShader: /* glsl */ `uniform vec2 shift;
    void main() {
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_Position.xy += shift * gl_Position.w;
    }`,
  fragmentShader: /* glsl */ `uniform vec3 color;
    void main() {
      gl_FragColor = vec4(color, 1.0);
      #include <colorspace_fragment>
    }`,
};

const always = { depthTest: false, depthWrite: false, transparent: true, toneMapped: false, side: THREE.DoubleSide } as const;

/** Draws lines around the pictures of frames, also where other shapes hide them. Outlines with another `number` (1, 2)
 * are independent. */
export class Outline {
  private readonly group = new THREE.Group();
  private readonly inside: THREE.Material;
  private readonly edges: THREE.ShaderMaterial[];
  private drawn: { copy: THREE.Mesh; of: THREE.Mesh }[] = [];
  private ids: readonly number[] = [];

  constructor(
    private readonly stage: Stage,
    private readonly frames: ReadonlyMap<number, Shown>,
    color: number,
    number: number,
  ) {
    const stencil = { ...always, stencilWrite: true, stencilRef: number };
    // Marks the pixels of the shapes; then draws them shifted in all directions, but not there.
    this.inside = new THREE.MeshBasicMaterial({ ...stencil, colorWrite: false, stencilZPass: THREE.ReplaceStencilOp });
    this.edges = Array.from({ length: DIRECTIONS }, () => new THREE.ShaderMaterial({
      ...stencil, ...EDGE_SHADER, stencilFunc: THREE.NotEqualStencilFunc,
      uniforms: { shift: { value: new THREE.Vector2() }, color: { value: new THREE.Color(color) } },
    }));
    stage.scene.add(this.group);
    stage.onDraw(() => this.follow());
  }

  /** Frames with an outline. */
  get count(): number {
    return this.drawn.length / (1 + DIRECTIONS);
  }

  show(ids: readonly number[]): void {
    this.ids = ids;
    this.refresh();
  }

  /** Call when frames have been added, removed or changed. */
  refresh(): void {
    this.group.clear();
    this.drawn = [];
    for (const id of new Set(this.ids)) {
      const object = this.frames.get(id)?.object;
      if (!(object instanceof THREE.Mesh) || object instanceof WideLines) continue;
      this.add(object, this.inside, ORDER);
      for (const edge of this.edges) this.add(object, edge, ORDER + 1);
    }
    this.stage.redraw();
  }

  private add(of: THREE.Mesh, material: THREE.Material, order: number): void {
    const copy = new THREE.Mesh(of.geometry, material);
    Object.assign(copy, { renderOrder: order, matrixAutoUpdate: false, frustumCulled: false, raycast: () => {} });
    this.drawn.push({ copy, of });
    this.group.add(copy);
  }

  private follow(): void {
    const { clientWidth: width, clientHeight: height } = this.stage.canvas;
    this.edges.forEach(({ uniforms }, i) => {
      const angle = (2 * Math.PI * i) / DIRECTIONS;
      (uniforms.shift!.value as THREE.Vector2).set((2 * WIDTH * Math.cos(angle)) / width, (2 * WIDTH * Math.sin(angle)) / height);
    });
    for (const { copy, of } of this.drawn) {
      of.updateWorldMatrix(true, false);
      copy.geometry = of.geometry;
      copy.matrix.copy(of.matrixWorld);
      copy.visible = of.visible && of.parent!.visible;
    }
  }
}
