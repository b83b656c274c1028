/** Constants of visualization_msgs' interactive markers. */

export const OrientationMode = { inherit: 0, fixed: 1, viewFacing: 2 } as const;

export const InteractionMode = {
  none: 0,
  menu: 1,
  button: 2,
  moveAxis: 3,
  movePlane: 4,
  rotateAxis: 5,
  moveRotate: 6,
  move3D: 7,
  rotate3D: 8,
  moveRotate3D: 9,
} as const;

export const FeedbackEvent = {
  keepAlive: 0,
  poseUpdate: 1,
  menuSelect: 2,
  buttonClick: 3,
  mouseDown: 4,
  mouseUp: 5,
} as const;

/** Action of a menu entry: a feedback message, or a program to run where rviz runs. */
export const MenuCommand = { feedback: 0, rosrun: 1, roslaunch: 2 } as const;
