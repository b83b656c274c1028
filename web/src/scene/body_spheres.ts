/** Spheres around the bodies of the simulated world: what a ray misses is not searched. */

import { Sphere, Vector3, type Mesh, type Object3D, type Ray } from "three";

const sphere = new Sphere();

interface Around {
  /** Of a sphere about the body's origin [m]. */
  readonly radius: number;
  /** What was below the body then. */
  readonly children: number;
}

export class BodySpheres {
  private readonly known = new WeakMap<Object3D, Around>();
  private readonly origin = new Vector3();

  /** True if a ray cannot meet anything of a body; false for what is no body. */
  isMissed(object: Object3D, ray: Ray): boolean {
    if (typeof object.userData["body"] !== "number") return false;
    let around = this.known.get(object);
    if (around?.children !== object.children.length) {
      around = { radius: radiusOf(object), children: object.children.length };
      this.known.set(object, around);
    }
    return ray.distanceSqToPoint(this.origin.setFromMatrixPosition(object.matrixWorld)) > around.radius * around.radius;
  }
}

/** Radius of a sphere about a body's origin that holds all below it; without end where bones move it. */
function radiusOf(body: Object3D): number {
  let radius = 0;
  const origin = new Vector3().setFromMatrixPosition(body.matrixWorld);
  body.traverse((object) => {
    const { geometry, isSkinnedMesh } = object as Partial<Mesh> & { readonly isSkinnedMesh?: boolean };
    if (geometry === undefined || !geometry.hasAttribute("position")) return;
    if (geometry.boundingSphere === null) geometry.computeBoundingSphere();
    if (isSkinnedMesh === true || geometry.boundingSphere === null) {
      radius = Infinity;
      return;
    }
    sphere.copy(geometry.boundingSphere).applyMatrix4(object.matrixWorld);
    radius = Math.max(radius, sphere.center.distanceTo(origin) + sphere.radius);
  });
  return radius;
}
