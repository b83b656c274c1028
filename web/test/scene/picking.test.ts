import "../../src/scene/conventions";

import {
  BoxGeometry,
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  Line,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Points,
  SphereGeometry,
  Vector3,
} from "three";
import { expect, test } from "vitest";

import { centreOn, freeArea } from "../../src/scene/free_area";
import { NOT_PICKED, Picker, toPicture } from "../../src/scene/picking";

const SIZE = { width: 800, height: 600 };

function cameraAt(x: number, y: number, z: number, target = new Vector3()): PerspectiveCamera {
  const camera = new PerspectiveCamera(50, SIZE.width / SIZE.height, 0.01, 100);
  camera.position.set(x, y, z);
  camera.lookAt(target);
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld();
  return camera;
}

function rootOf(...objects: (Mesh | Points | Line)[]): Group {
  const root = new Group();
  root.add(...objects);
  root.updateMatrixWorld(true);
  return root;
}

test("the nearest visible mesh is picked, on its surface", () => {
  const near = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial());
  const far = new Mesh(new SphereGeometry(1, 64, 64), new MeshBasicMaterial());
  far.position.set(-3, 0, 0);
  const camera = cameraAt(5, 0, 0);
  const picker = new Picker();

  const first = picker.pick([rootOf(near, far)], camera, SIZE, 400, 300);
  near.visible = false;
  const second = picker.pick([rootOf(near, far)], camera, SIZE, 400, 300);

  expect(first?.object).toBe(near);
  expect(first?.point.x).toBeCloseTo(0.5);
  expect(second?.object).toBe(far);
  expect(second?.point.x).toBeCloseTo(-2, 2);
});

test("objects excluded from picking are not picked", () => {
  const box = new Mesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial());
  const root = rootOf(box);
  root.userData[NOT_PICKED] = true;
  expect(new Picker().pick([root], cameraAt(5, 0, 0), SIZE, 400, 300)).toBeNull();
});

test("a point is picked within some pixels, at any distance, with its index", () => {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute([0, 1, 0, -60, 0, 0], 3));
  const points = new Points(geometry);
  const camera = cameraAt(5, 0, 0);
  const at = toPicture(new Vector3(-60, 0, 0), camera, SIZE);

  const hit = new Picker().pick([rootOf(points)], camera, SIZE, (at?.x ?? 0) + 4, at?.y ?? 0);
  const missed = new Picker().pick([rootOf(points)], camera, SIZE, (at?.x ?? 0) + 12, at?.y ?? 0);

  expect(hit?.index).toBe(1);
  expect(hit?.point.x).toBeCloseTo(-60);
  expect(missed).toBeNull();
});

test("a line is picked between its points", () => {
  const line = new Line(new BufferGeometry().setFromPoints([new Vector3(0, -1, 0), new Vector3(0, 1, 0)]));
  const hit = new Picker().pick([rootOf(line)], cameraAt(5, 0, 0), SIZE, 400, 304);
  expect(hit?.object).toBe(line);
  expect(hit?.point.length()).toBeLessThan(0.05);
});

test("instances are picked with their index", () => {
  const boxes = new InstancedMesh(new BoxGeometry(1, 1, 1), new MeshBasicMaterial(), 2);
  boxes.setMatrixAt(0, new Matrix4().makeTranslation(0, 2, 0));
  boxes.setMatrixAt(1, new Matrix4().makeTranslation(0, 0, 0));
  expect(new Picker().pick([rootOf(boxes)], cameraAt(5, 0, 0), SIZE, 400, 300)?.index).toBe(1);
});

test("the ground is met where the ray crosses z = 0; not above the horizon", () => {
  const camera = cameraAt(0, 0, 5, new Vector3(5, 0, 0));
  const picker = new Picker();
  const hit = picker.pickGround(camera, SIZE, 400, 300);
  expect(hit?.x).toBeCloseTo(5);
  expect(hit?.z).toBeCloseTo(0);
  expect(picker.pickGround(cameraAt(0, 0, 5, new Vector3(5, 0, 8)), SIZE, 400, 300)).toBeNull();
});

test("the camera's axis goes through the middle of the free area", () => {
  const camera = cameraAt(5, 0, 0);
  centreOn(
    freeArea(SIZE.width, SIZE.height, { left: 200, right: 0, top: 40, bottom: 100 }),
    camera,
    SIZE.width,
    SIZE.height,
  );
  camera.updateProjectionMatrix();

  const projected = toPicture(new Vector3(), camera, SIZE);

  expect(projected?.x).toBeCloseTo(500);
  expect(projected?.y).toBeCloseTo(270);
});
