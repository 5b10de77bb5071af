import * as THREE from "three";

const SUN = new THREE.Vector3(-2.5, 2.2, 4.5),
  FILL = new THREE.Vector3(3, -2, 2.5); // directions towards the lights
const CENTER = new THREE.Vector3(0, 0, 0.8); // target of the program's lights
const SHADOW_PIXELS = 2048; // across the light's view
const SOFTNESS = 5; // pixels, width of the shadows' edges
const USUAL_SHADOWED = 1; // m; much smaller scenes have finer shadows
const NORMAL_BIAS = 0.006,
  FINEST_FOR_BIAS = 12; // m: largest scene whose shadow map is fine enough for it

/** The sky, a sun that casts shadows, and a weaker light from the other side; or the program's lights. */
export class Lights {
  readonly group = new THREE.Group();
  private readonly sky = new THREE.HemisphereLight(0xf6f9ff, 0x7d7b7a, 1.85);
  private readonly flat = new THREE.AmbientLight(0xffffff, Math.PI);
  private readonly sun = new THREE.DirectionalLight(0xfff6ea, 2.35);
  private readonly others = new THREE.Group();
  private readonly towards = SUN.clone().normalize();
  private readonly center = new THREE.Vector3();
  private radius = USUAL_SHADOWED;

  constructor() {
    const { shadow } = this.sun;
    this.sun.castShadow = true;
    this.sky.position.set(0, 0, 1); // the direction of the sky
    shadow.bias = -0.0002;
    this.group.add(this.sky, this.flat, this.sun, this.sun.target, this.others);
    this.setCoarse(false);
    this.setAppearance([], false, true);
  }

  /** `coarse`: shadows with fewer pixels and hard edges. Returns whether they need to be drawn again. */
  setCoarse(coarse: boolean): boolean {
    const { shadow } = this.sun;
    const size = coarse ? SHADOW_PIXELS / 2 : SHADOW_PIXELS;
    if (shadow.mapSize.x === size) return false;
    shadow.mapSize.set(size, size);
    shadow.radius = coarse ? 0 : SOFTNESS;
    shadow.map?.dispose();
    shadow.map = null;
    return true;
  }

  /** `places`: positions of the lights, three numbers each; empty: the default lights. `flat`: colors without shading.
   * */
  setAppearance(places: readonly number[], flat: boolean, shadows: boolean): void {
    const given = Array.from({ length: Math.floor(places.length / 3) }, (_, i) =>
      new THREE.Vector3(...places.slice(3 * i)).sub(CENTER),
    );
    const [sun = SUN, ...others] = given.length > 0 ? given : [SUN, FILL];
    this.towards.copy(sun).normalize();
    this.others.clear();
    for (const place of others) {
      const light =
        given.length > 0 ? new THREE.DirectionalLight(0xffffff, 1.2) : new THREE.DirectionalLight(0xe3ebff, 0.55);
      light.position.copy(place);
      this.others.add(light);
    }
    this.flat.visible = flat;
    this.sky.visible = this.sun.visible = this.others.visible = !flat;
    this.sun.castShadow = shadows;
    this.fitShadows(this.center, this.radius);
  }

  /** Lets the whole scene within a ball cast shadows of any size and position. */
  fitShadows(center: THREE.Vector3, radius: number): void {
    this.center.copy(center);
    this.radius = radius;
    const reach = Math.max(1.1 * radius, Math.min(USUAL_SHADOWED, 8 * radius));
    const { camera } = this.sun.shadow;
    this.sun.shadow.normalBias = NORMAL_BIAS * Math.min(1, reach) * Math.max(1, reach / FINEST_FOR_BIAS);
    this.sun.target.position.copy(center);
    this.sun.position.copy(center).addScaledVector(this.towards, 2 * reach);
    Object.assign(camera, {
      left: -reach,
      right: reach,
      top: reach,
      bottom: -reach,
      near: 0.1 * reach,
      far: 4 * reach,
    });
    camera.updateProjectionMatrix();
  }
}
