/** Mass of a link: its centre, and the box of even density that has the same inertia. */

import { BoxGeometry, EdgesGeometry, Euler, Group, Mesh, ShaderMaterial, type Object3D } from "three";

import type { LinkInfo } from "../../protocol/generated/page_messages";
import { principalAxes } from "../../shapes/eigen";
import { BOX, SPHERE } from "../../shapes/solids";
import type { SixNumbers } from "../simulated_world";
import { area, COLORS, inFront, lines } from "./overlay_shapes";

/** Density of lead [kg/m³]: Gazebo draws a centre of mass as a ball of lead. */
const LEAD = 11340;
/** Smallest ball's radius, and smallest side of a box [m]. */
const SMALLEST = { radius: 0.008, side: 1e-3 };

const CHECKERED = new ShaderMaterial({
  vertexShader:
    "varying vec3 at; void main() { at = position; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }",
  fragmentShader:
    "varying vec3 at; void main() { float side = at.x * at.y * at.z; gl_FragColor = vec4(vec3(side < 0.0 ? 0.02 : 0.96), 1.0); }",
  transparent: true,
  depthTest: false,
  depthWrite: false,
});

/** A black and white ball at the centre of mass. */
export function drawCentre({ mass, inertial_pose }: LinkInfo): Object3D {
  const ball = inFront(new Mesh(SPHERE, CHECKERED));
  ball.scale.setScalar(2 * Math.max(SMALLEST.radius, Math.cbrt((3 * mass) / (4 * Math.PI * LEAD))));
  place(ball, inertial_pose);
  return ball;
}

/** Sides [m] of the box of even density with these moments about its principal axes [kg m²]. */
function equivalentBox(mass: number, [x, y, z]: readonly [number, number, number]): [number, number, number] {
  const side = (squared: number): number => Math.max(SMALLEST.side, Math.sqrt(Math.max(0, (6 * squared) / mass)));
  return [side(y + z - x), side(x + z - y), side(x + y - z)];
}

/** The box of even density with the link's mass and inertia. */
export function drawInertia({ mass, inertia: [xx, yy, zz, xy, xz, yz], inertial_pose }: LinkInfo): Object3D {
  const { values, rotation } = principalAxes([xx, xy, xz, xy, yy, yz, xz, yz, zz]);
  const box = new Group();
  box.quaternion.copy(rotation);
  box.scale.set(...equivalentBox(mass, values));
  box.add(area(BOX, COLORS.inertia, 0.2), lines(EDGES, COLORS.inertia));
  const group = new Group();
  place(group, inertial_pose);
  group.add(box);
  return group;
}

const EDGES = [...new EdgesGeometry(new BoxGeometry(1, 1, 1)).getAttribute("position").array];

/** Put an object where a pose of the manifest is. */
export function place(object: Object3D, [x, y, z, roll, pitch, yaw]: SixNumbers): void {
  object.position.set(x, y, z);
  object.quaternion.setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
}
