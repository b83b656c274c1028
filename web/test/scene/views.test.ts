import "../../src/scene/conventions";

import { OrthographicCamera, PerspectiveCamera, Quaternion, Vector3 } from "three";
import { expect, test } from "vitest";

import type { CameraInfo } from "../../src/protocol/generated/page_messages";
import type { Transform } from "../../src/frames/transform";
import { freeArea } from "../../src/scene/free_area";
import { toPicture } from "../../src/scene/picking";
import { CameraMotion, SmoothPose } from "../../src/scene/views/camera_motion";
import { Fps } from "../../src/scene/views/fps";
import { Orbit } from "../../src/scene/views/orbit";
import { ThirdPersonFollower } from "../../src/scene/views/third_person_follower";
import { TopDownOrtho } from "../../src/scene/views/top_down_ortho";
import { ORIGIN, type Picture, type View } from "../../src/scene/views/view";
import { SensorCamera } from "../../src/scene/views/sensor_camera";
import { copyOfView, loadView } from "../../src/scene/views/view_classes";
import { XYOrbit } from "../../src/scene/views/xy_orbit";

const SIZE = { width: 800, height: 600 };
const PICTURE: Picture = { ...SIZE, free: freeArea(800, 600, { left: 0, right: 0, top: 0, bottom: 0 }) };

function at(x: number, y: number, z: number, yaw = 0): Transform {
  return { position: new Vector3(x, y, z), orientation: new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), yaw) };
}

/** The camera as a view places it, ready to project. */
function placed(view: View, target = ORIGIN): PerspectiveCamera | OrthographicCamera {
  const camera = view.kind === "perspective" ? new PerspectiveCamera(45, 800 / 600) : new OrthographicCamera();
  view.place(camera, target, PICTURE);
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  return camera;
}

function pixel(view: View, point: Vector3, target = ORIGIN): Vector3 {
  return toPicture(point.clone(), placed(view, target), SIZE) ?? new Vector3(NaN, NaN, NaN);
}

test("Orbit's eye follows rviz's formula, and looks at the focal point", () => {
  const view = new Orbit();
  view.load({ Distance: 2, Yaw: 0.5, Pitch: 0.3, "Focal Point": { X: 1, Y: 2, Z: 3 } });
  const { position } = placed(view);
  expect(position.x).toBeCloseTo(1 + 2 * Math.cos(0.5) * Math.cos(0.3));
  expect(position.y).toBeCloseTo(2 + 2 * Math.sin(0.5) * Math.cos(0.3));
  expect(position.z).toBeCloseTo(3 + 2 * Math.sin(0.3));
  expect(pixel(view, new Vector3(1, 2, 3)).x).toBeCloseTo(400);
});

test.each([new Orbit(), new XYOrbit(), new TopDownOrtho()])(
  "panning carries what lies at the focal point along with the pointer",
  (view) => {
    view.pan(30, -20, PICTURE);
    const after = pixel(view, new Vector3());
    expect(after.x - 400).toBeCloseTo(30, -1);
    expect(after.y - 300).toBeCloseTo(-20, -1);
  },
);

test("XYOrbit keeps its focal point on the ground", () => {
  const view = new XYOrbit();
  view.mimic(new Vector3(5, 0, 5), new Vector3(0, 0, 1), ORIGIN);
  expect(view.focalPoint.value.value[2]).toBeCloseTo(0);
  view.pan(10, 50, PICTURE);
  expect(view.focalPoint.value.value[2]).toBe(0);
});

test.each([new Orbit(), new Fps(), new TopDownOrtho()])(
  "a framed sphere fills most of the free part and stays inside it",
  (view) => {
    const centre = new Vector3(3, -2, 1);
    const motion = new CameraMotion(view.frame(centre, 2, ORIGIN, PICTURE));
    while (!motion.advance(0.05));
    const middle = pixel(view, centre);
    expect(middle.x).toBeCloseTo(400);
    expect(middle.y).toBeCloseTo(300);
    const up = new Vector3(0, 1, 0).applyQuaternion(placed(view).quaternion);
    const top = pixel(view, centre.clone().addScaledVector(up, 2));
    expect(300 - top.y).toBeGreaterThan(220);
    expect(300 - top.y).toBeLessThanOrEqual(300);
  },
);

test("in the top view x is to the right and y is up", () => {
  const view = new Orbit();
  new CameraMotion(view.lookFrom("top")).advance(10);
  expect(pixel(view, new Vector3(1, 0, 0)).x).toBeGreaterThan(410);
  expect(pixel(view, new Vector3(0, 1, 0)).y).toBeLessThan(290);
});

test("TopDownOrtho shows Scale pixels per metre, x to the right", () => {
  const view = new TopDownOrtho();
  view.load({ Scale: 50, X: 1, Y: 2 });
  const point = pixel(view, new Vector3(3, 2, 0));
  expect(point.x).toBeCloseTo(500);
  expect(point.y).toBeCloseTo(300);
});

test("FPS at yaw 0 looks along x, and a positive pitch looks down", () => {
  const view = new Fps();
  view.load({ Position: { X: 0, Y: 0, Z: 0 }, Yaw: 0, Pitch: 0 });
  expect(pixel(view, new Vector3(5, 0, 0)).x).toBeCloseTo(400);
  expect(pixel(view, new Vector3(5, 1, 0)).x).toBeLessThan(400);
  expect(pixel(view, new Vector3(5, 0, 1)).y).toBeLessThan(300);
  view.load({ Pitch: 0.3 });
  expect(pixel(view, new Vector3(5, 0, -5 * Math.tan(0.3))).y).toBeCloseTo(300);
});

test("Orbit follows only its target's position; ThirdPersonFollower also its yaw", () => {
  const target = at(10, 5, 1, Math.PI / 2);
  const [orbit, follower] = [new Orbit(), new ThirdPersonFollower()];
  for (const view of [orbit, follower]) view.load({ Yaw: Math.PI, Distance: 4, Pitch: 0 });
  expect(placed(orbit, target).position.distanceTo(new Vector3(6, 5, 1))).toBeLessThan(1e-6);
  expect(placed(follower, target).position.distanceTo(new Vector3(10, 1, 0))).toBeLessThan(1e-6);
});

test.each([new Orbit(), new Fps(), new TopDownOrtho()])("another target frame does not change the picture", (view) => {
  const before = placed(view).position.clone();
  const target = at(2, 3, 0);
  view.shift(ORIGIN, target);
  const after = placed(view, target).position;
  expect(after.distanceTo(before)).toBeLessThan(1e-6);
});

test("a view keeps unknown keys, and names invalid values", () => {
  const view = new Orbit();
  const faults = view.load({ Class: "rviz/Orbit", Name: "A", Distance: "far", "Focal Shape Size": 0.05, Yaw: 1 });
  expect(faults).toEqual(['Distance: "far" is no number']);
  expect(view.save()).toMatchObject({ Class: "rviz/Orbit", Name: "A", "Focal Shape Size": 0.05, Yaw: 1, Distance: 10 });
});

test("a followed pose converges, and jumps are applied at once", () => {
  const pose = new SmoothPose();
  const target = at(1, 0, 0, 1);
  pose.follow(target, 1 / 60);
  expect(pose.position.x).toBeGreaterThan(0.1);
  expect(pose.position.x).toBeLessThan(0.9);
  for (let i = 0; i < 120; i += 1) pose.follow(target, 1 / 60);
  expect(pose.position.x).toBe(1);
  pose.follow(at(50, 0, 0), 1 / 60);
  expect(pose.position.x).toBe(50);
});

test("a simulated camera's view stays one when it is saved and loaded, and when it is copied", () => {
  const camera = {
    name: "eye",
    topic: "/eye",
    body: 3,
    pose: [0.1, 0, 0.2, 0, 0.3, 0],
    width: 640,
    height: 360,
    horizontal_fov: 1.2,
    near: 0.05,
  } as unknown as CameraInfo;
  const view = SensorCamera.of(camera, "robot::head");
  const file = view.save();
  expect(file["Class"]).toBe("rviz/FrameAligned");
  for (const again of [loadView(file, []), copyOfView(view, "copy")]) {
    expect(again).toBeInstanceOf(SensorCamera);
    expect((again as SensorCamera).rectangle(PICTURE)).toEqual(view.rectangle(PICTURE));
    expect(again?.save()).toEqual({ ...file, Name: again?.name.value });
  }
  expect(loadView({ Class: "rviz/FrameAligned" }, [])).not.toBeInstanceOf(SensorCamera);
});
