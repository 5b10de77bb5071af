import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";

function isSeen(object: THREE.Object3D): boolean {
  return object.visible && (object.parent === null || isSeen(object.parent));
}

/** Canvas, camera, lights and floor: everything but the scene itself. Draws only when something has changed. */
export class Stage {
  readonly scene = new THREE.Scene();
  readonly frames = new THREE.Group();
  readonly camera = new THREE.PerspectiveCamera(40, 1, 0.01, 200);
  readonly renderer: THREE.WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly labels = new CSS2DRenderer();
  private readonly sun = new THREE.DirectionalLight(0xffffff, 2.1);
  private dirty = true;

  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.labels.domElement.className = "labels";
    canvas.after(this.labels.domElement);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.redraw());
    this.addLights();
    this.addFloor();
    this.scene.add(this.frames);
    this.lookFrom(new THREE.Vector3(1.5, 2.6, 1.8), new THREE.Vector3(0, 0, 0.9));
    addEventListener("resize", () => this.resize());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paper());
    canvas.addEventListener("dblclick", (event) => this.focus(event));
    this.paper();
    this.resize();
    this.renderer.setAnimationLoop(() => this.draw());
  }

  lookFrom(position: THREE.Vector3, target: THREE.Vector3): void {
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
    this.controls.saveState();
    this.redraw();
  }

  home(): void {
    this.controls.reset();
    this.redraw();
  }

  redraw(): void {
    this.dirty = true;
  }

  /** True if what is on the screen is up to date. */
  get idle(): boolean {
    return !this.dirty;
  }

  private addLights(): void {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xb9b4aa, 1.7));
    this.sun.position.set(-2.5, 2.2, 5);
    this.sun.target.position.set(0, 0, 0.5);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 5;
    this.sun.shadow.bias = -0.0003;
    this.sun.shadow.normalBias = 0.01;
    const reach = 2.6;
    Object.assign(this.sun.shadow.camera, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.5, far: 12 });
    this.scene.add(this.sun, this.sun.target);
    const fill = new THREE.DirectionalLight(0xdfe8ff, 0.7);
    fill.position.set(3, -2, 2.5);
    this.scene.add(fill);
  }

  private addFloor(): void {
    const floor = new THREE.Mesh(new THREE.PlaneGeometry(40, 40), new THREE.ShadowMaterial({ opacity: 0.22 }));
    floor.receiveShadow = true;
    floor.position.z = -0.001;
    this.scene.add(floor);
    const fine = new THREE.GridHelper(10, 50, 0x8a93a0, 0x8a93a0).rotateX(Math.PI / 2);
    const coarse = new THREE.GridHelper(10, 10, 0x6f7885, 0x6f7885).rotateX(Math.PI / 2);
    for (const [grid, opacity] of [[fine, 0.16], [coarse, 0.5]] as const) {
      Object.assign(grid.material, { transparent: true, opacity, depthWrite: false });
      grid.position.z = -0.002;
      this.scene.add(grid);
    }
  }

  private paper(): void {
    const color = getComputedStyle(document.documentElement).getPropertyValue("--paper").trim();
    this.scene.background = new THREE.Color(color);
    this.scene.fog = new THREE.Fog(color, 9, 28);
    this.redraw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.renderer.setSize(width, height, false);
    this.labels.setSize(width, height);
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.updateProjectionMatrix();
    this.redraw();
  }

  /** Lets the browser save what is seen, without names and panels, as a PNG file. */
  savePicture(file: string): void {
    this.redraw();
    this.draw();
    const link = document.createElement("a");
    link.href = this.canvas.toDataURL("image/png");
    link.download = file;
    link.click();
  }

  /** A double click turns about the point that was hit from there on. */
  private focus(event: MouseEvent): void {
    const at = new THREE.Vector2((2 * event.offsetX) / this.canvas.clientWidth - 1, 1 - (2 * event.offsetY) / this.canvas.clientHeight);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.camera);
    const hit = ray.intersectObject(this.frames, true).find(({ object }) => object instanceof THREE.Mesh && isSeen(object));
    if (!hit) return;
    this.controls.target.copy(hit.point);
    this.controls.update();
    this.redraw();
  }

  private draw(): void {
    if (!this.dirty) return;
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
    this.labels.render(this.scene, this.camera);
  }
}
