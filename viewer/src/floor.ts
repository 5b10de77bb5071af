import * as THREE from "three";

const LINED = 30; // large squares to each side of the camera, which have lines and shadows; more in large scenes
const DEPTH = 0.001; // m per meter of a square: depth of the floor below z = 0; it must not hide the bottoms of shapes

const GRID = /* glsl */ `
uniform vec3 ink;
uniform float square; // m
uniform float share; // share of the pixels in each direction of a fine picture
varying vec2 vFloor;
float gridLine(float spacing) {
  vec2 at = vFloor / spacing, width = fwidth(at);
  vec2 far = abs(fract(at - 0.5) - 0.5) / max(width, vec2(1e-6));
  return (1.0 - min(min(far.x, far.y), 1.0)) * (1.0 - smoothstep(0.15, 0.5, max(width.x, width.y)));
}
float axisLine(float across) { return 1.0 - min(abs(across) / max(1.5 * fwidth(across), 1e-6), 1.0); }
`;

// black in the shadow, lines, red along x and green along y
const PAINT = /* glsl */ `
float reach = 1.0 - smoothstep(3.0, 14.0, length(vFloor - cameraPosition.xy) / square);
float line = max(0.16 * gridLine(0.2 * square), 0.42 * gridLine(square)) * reach;
float alongX = axisLine(vFloor.y) * reach, alongY = axisLine(vFloor.x) * reach;
float night = step(0.35, ink.g);
vec3 red = mix(vec3(0.45, 0.05, 0.05), vec3(0.8, 0.2, 0.18), night);
vec3 green = mix(vec3(0.05, 0.28, 0.08), vec3(0.12, 0.6, 0.22), night);
vec3 colored = mix(mix(ink, green, alongY), red, alongX);
float drawn = share * max(line, 0.6 * max(alongX, alongY));
float shade = opacity * (1.0 - getShadowMask());
float covered = shade + drawn * (1.0 - shade);
gl_FragColor = vec4(colored * drawn * (1.0 - shade) / max(covered, 1e-4), covered);
`;

function gridMaterial(ink: THREE.Color, share: { value: number }, square: { value: number }): THREE.Material {
  const material = new THREE.ShadowMaterial({ opacity: 0.26, depthWrite: false, side: THREE.DoubleSide });
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, { ink: { value: ink }, share, square });
    shader.vertexShader = shader.vertexShader
      .replace("void main() {", "varying vec2 vFloor;\nvoid main() {")
      .replace(
        "#include <shadowmap_vertex>",
        THREE.ShaderChunk.shadowmap_vertex.replace(/ \+ vec4\( shadowWorldNormal[^;]*;/g, ";"),
      )
      .replace("#include <fog_vertex>", "#include <fog_vertex>\nvFloor = (modelMatrix * vec4(position, 1.0)).xy;");
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", `${GRID}\nvoid main() {`)
      .replace(/gl_FragColor = [^;]*;/, PAINT);
  };
  return material;
}

/** The floor at z = 0: it receives shadows, and has lines around large squares and around five by five small ones in
 * each; the x axis is red, the y axis green. */
export class Floor {
  readonly group = new THREE.Group();
  private readonly ink = new THREE.Color();
  private readonly share = { value: 1 };
  private readonly square = { value: 1 }; // m
  private readonly grid = new THREE.Mesh(
    new THREE.PlaneGeometry(2, 2),
    gridMaterial(this.ink, this.share, this.square),
  );
  private readonly solid = new THREE.Mesh(
    new THREE.PlaneGeometry(2, 2),
    new THREE.MeshStandardMaterial({ roughness: 0.9 }),
  );

  constructor() {
    this.grid.receiveShadow = true;
    this.grid.renderOrder = -1; // before transparent shapes, which it would cover otherwise
    this.solid.visible = false;
    this.group.add(this.solid, this.grid);
    this.setSquare(1);
  }

  /** Size of the large squares, m. */
  setSquare(size: number): void {
    this.square.value = size;
    this.grid.position.z = -DEPTH * Math.min(size, 1);
    this.solid.position.z = -2 * DEPTH * Math.min(size, 1);
  }

  /** Centers the lines at the camera. They are one pixel wide, hence paler in coarse pictures: `share` is the
   * resolution relative to full. `reach`: distance of the farthest shape; `far`: of the end of sight, m. */
  follow(camera: THREE.Vector3, share: number, reach: number, far: number): void {
    this.share.value = share;
    const half = Math.max(LINED * this.square.value, reach);
    this.grid.scale.set(half, half, 1);
    this.solid.scale.set(far, far, 1);
    for (const plane of [this.grid, this.solid]) plane.position.set(camera.x, camera.y, plane.position.z);
  }

  /** Makes lines dark on a light background, and light on a dark one. */
  setPaper({ r, g, b }: THREE.Color): void {
    const bright = 0.2 * r + 0.7 * g + 0.1 * b > 0.2;
    if (bright) this.ink.setRGB(0.17, 0.2, 0.24);
    else this.ink.setRGB(0.5, 0.54, 0.6);
  }

  /** Sets a solid floor of that color below the lines; null: none. */
  setColor(color: THREE.Color | null): void {
    this.solid.visible = color !== null;
    if (color) this.solid.material.color.copy(color);
  }
}
