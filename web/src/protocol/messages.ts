/** Types of the messages that displays, tools and panels know. */

export type * from "./messages/geometry_msgs";
export type * from "./messages/nav_msgs";
export type * from "./messages/sensor_msgs";
export type * from "./messages/std_msgs";
export type * from "./messages/system_msgs";
export type * from "./messages/visualization_msgs";
