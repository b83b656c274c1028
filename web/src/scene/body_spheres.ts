/** Spheres around the bodies of the simulated world: what a ray misses is not searched. */

import { Sphere, type Mesh, type Object3D, type Ray } from "three";

const own = new Sphere();

interface Around {
  readonly sphere: Sphere;
  /** What was below the body then. */
  readonly children: number;
}

export class BodySpheres {
  private readonly known = new WeakMap<Object3D, Around>();
  private readonly inWorld = new Sphere();

  /** True if a ray cannot meet anything of a body; false for what is no body. */
  isMissed(object: Object3D, ray: Ray): boolean {
    if (typeof object.userData["body"] !== "number") return false;
    let around = this.known.get(object);
    if (around?.children !== object.children.length) {
      around = { sphere: sphereOf(object), children: object.children.length };
      this.known.set(object, around);
    }
    return !ray.intersectsSphere(this.inWorld.copy(around.sphere).applyMatrix4(object.matrixWorld));
  }
}

/** Sphere about a body's origin that holds all below it, in the body's frame; without end where bones move it. */
function sphereOf(body: Object3D): Sphere {
  const around = new Sphere(undefined, 0);
  const origin = around.center.clone().setFromMatrixPosition(body.matrixWorld);
  body.traverse((object) => {
    const { geometry, isSkinnedMesh } = object as Partial<Mesh> & { readonly isSkinnedMesh?: boolean };
    if (geometry === undefined || !geometry.hasAttribute("position")) return;
    if (geometry.boundingSphere === null) geometry.computeBoundingSphere();
    if (isSkinnedMesh === true || geometry.boundingSphere === null) {
      around.radius = Infinity;
      return;
    }
    own.copy(geometry.boundingSphere).applyMatrix4(object.matrixWorld);
    around.radius = Math.max(around.radius, own.center.distanceTo(origin) + own.radius);
  });
  return around;
}
