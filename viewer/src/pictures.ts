import * as THREE from "three";

/** Triangles of a mesh with an image: first triangle, count, and the number of the image. */
export type TexturedTriangles = [first: number, count: number, picture: number];

/** The images on meshes, by the server's numbers. */
export class Pictures {
  private readonly textures = new Map<number, THREE.Texture>();
  private waiting = 0;

  /** `loaded` is called when an image has been decoded. */
  constructor(private readonly loaded: () => void) {}

  /** True while images are being decoded. */
  get busy(): boolean {
    return this.waiting > 0;
  }

  get(number: number): THREE.Texture | null {
    return this.textures.get(number) ?? null;
  }

  read(data: ArrayBuffer): void {
    const texture = new THREE.Texture();
    Object.assign(texture, { colorSpace: THREE.SRGBColorSpace, wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, anisotropy: 8, flipY: false });
    this.textures.set(new DataView(data).getUint32(4, true), texture);
    void this.unpack(texture, new Blob([data.slice(8)]));
  }

  /** Frees all other images. */
  keep(used: ReadonlySet<number>): void {
    for (const [number, texture] of this.textures) {
      if (used.has(number)) continue;
      texture.dispose();
      this.textures.delete(number);
    }
  }

  private async unpack(texture: THREE.Texture, file: Blob): Promise<void> {
    ++this.waiting;
    try {
      texture.image = await createImageBitmap(file, { imageOrientation: "flipY" });
      texture.needsUpdate = true;
    } catch { // a damaged image leaves the shape white
    } finally {
      --this.waiting;
      this.loaded();
    }
  }
}
