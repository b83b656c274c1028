/** Bounding spheres of the simulated bodies, so that picking skips bodies that the ray misses. */

import { Sphere, Vector3, type Mesh, type Object3D, type Ray } from "three";

const sphere = new Sphere();

interface Around {
  /** Radius of a sphere about the body's origin [m]. */
  readonly radius: number;
  /** Number of the body's children when the radius was computed. */
  readonly children: number;
}

export class BodySpheres {
  private readonly known = new WeakMap<Object3D, Around>();
  private readonly origin = new Vector3();

  /** True if a ray misses a body; false for objects that are no bodies. */
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

/** Radius of a sphere about a body's origin that contains its children; infinite if bones move them. */
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
