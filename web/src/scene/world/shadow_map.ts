/** Shadow map of a directional or spot light, fitted to what casts shadows, as in cpp/render/light.cc. */

import {
  Box3,
  DepthTexture,
  FloatType,
  LessEqualCompare,
  LinearFilter,
  Matrix4,
  MeshBasicMaterial,
  OrthographicCamera,
  PerspectiveCamera,
  Vector3,
  WebGLRenderTarget,
  type Mesh,
  type Scene,
  type WebGLRenderer,
} from "three";

/** Layer of the objects that cast shadows. */
export const CASTERS = 1;
/** Target width of a texel [m]. */
const TEXEL = 0.005;
const [MIN_SIZE, MAX_SIZE] = [512, 2048];
const SPOT_SIZE = 1024;
const SPOT_FAR = 200;
const NEAR = 0.01;
/** Texels at the edge that stay free of shadow casters. */
const MARGIN = 4;

export class ShadowMap {
  /** The shader's values. */
  readonly uniform = { view: new Matrix4(), projection: new Matrix4(), texel: 0, isActive: false };
  private target: WebGLRenderTarget | null = null;
  private readonly orthographic = new OrthographicCamera();
  private readonly perspective = new PerspectiveCamera();
  private readonly override = new MeshBasicMaterial({ colorWrite: false });
  private readonly box = new Box3();
  private readonly corner = new Vector3();

  constructor() {
    for (const camera of [this.orthographic, this.perspective]) camera.layers.set(CASTERS);
  }

  get texture(): DepthTexture | null {
    return this.target?.depthTexture ?? null;
  }

  dispose(): void {
    this.target?.dispose();
    this.override.dispose();
  }

  /** Draw the casters as a directional light sees them. */
  drawDirectional(renderer: WebGLRenderer, scene: Scene, direction: Vector3, casters: readonly Mesh[]): void {
    const camera = this.orthographic;
    camera.position.set(0, 0, 0);
    aim(camera, direction);
    const { min, max } = this.extent(camera, casters);
    const extent = Math.max(max.x - min.x, max.y - min.y, 1e-3);
    this.uniform.isActive = Number.isFinite(extent);
    if (!this.uniform.isActive) return;
    let size = MIN_SIZE;
    while (size < MAX_SIZE && extent / size > TEXEL) size *= 2;
    const texel = extent / (size - MARGIN);
    camera.position.set((min.x + max.x) / 2, (min.y + max.y) / 2, max.z + 1).applyQuaternion(camera.quaternion);
    camera.right = (size / 2) * texel;
    Object.assign(camera, {
      left: -camera.right,
      top: camera.right,
      bottom: -camera.right,
      near: 0,
      far: max.z - min.z + 2,
    });
    this.draw(renderer, scene, camera, size, texel);
  }

  /** Draw the casters as a spot light sees them; `angle`: its whole cone [rad]. */
  drawSpot(
    renderer: WebGLRenderer,
    scene: Scene,
    position: Vector3,
    direction: Vector3,
    angle: number,
    range: number,
  ): void {
    const camera = this.perspective;
    const half = Math.min(angle / 2, 1.4);
    camera.position.copy(position);
    aim(camera, direction);
    camera.fov = (half * 360) / Math.PI;
    camera.near = NEAR;
    camera.far = Math.min(range, SPOT_FAR);
    this.uniform.isActive = true;
    this.draw(renderer, scene, camera, SPOT_SIZE, (2 * Math.tan(half)) / SPOT_SIZE);
  }

  /** Box of the casters in the camera's axes. */
  private extent(camera: OrthographicCamera, casters: readonly Mesh[]): Box3 {
    camera.updateMatrixWorld();
    const box = this.box.makeEmpty();
    for (const mesh of casters) {
      if (mesh.geometry.boundingBox === null) mesh.geometry.computeBoundingBox();
      const bounds = mesh.geometry.boundingBox;
      if (bounds === null || bounds.isEmpty()) continue;
      for (let i = 0; i < 8; i += 1) {
        this.corner.set(
          i & 1 ? bounds.max.x : bounds.min.x,
          i & 2 ? bounds.max.y : bounds.min.y,
          i & 4 ? bounds.max.z : bounds.min.z,
        );
        box.expandByPoint(this.corner.applyMatrix4(mesh.matrixWorld).applyMatrix4(camera.matrixWorldInverse));
      }
    }
    return box;
  }

  private draw(
    renderer: WebGLRenderer,
    scene: Scene,
    camera: OrthographicCamera | PerspectiveCamera,
    size: number,
    texel: number,
  ): void {
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    this.uniform.view.copy(camera.matrixWorldInverse);
    this.uniform.projection.copy(camera.projectionMatrix);
    this.uniform.texel = texel;
    const before = renderer.getRenderTarget();
    scene.overrideMaterial = this.override;
    renderer.setRenderTarget(this.targetOf(size));
    renderer.render(scene, camera);
    renderer.setRenderTarget(before);
    scene.overrideMaterial = null;
  }

  private targetOf(size: number): WebGLRenderTarget {
    if (this.target?.width === size) return this.target;
    this.target?.dispose();
    const depth = new DepthTexture(size, size, FloatType);
    depth.compareFunction = LessEqualCompare;
    depth.minFilter = depth.magFilter = LinearFilter; // compares four texels, each by itself
    this.target = new WebGLRenderTarget(size, size, { depthTexture: depth });
    return this.target;
  }
}

function aim(camera: OrthographicCamera | PerspectiveCamera, direction: Vector3): void {
  camera.up.set(0, 0, 1);
  if (Math.abs(direction.z) > 0.99 * direction.length()) camera.up.set(0, 1, 0);
  camera.lookAt(camera.position.clone().add(direction));
  camera.updateMatrixWorld();
}
