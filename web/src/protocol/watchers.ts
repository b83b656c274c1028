/** Nodes that only watch a graph, by the names that their programs give them. */

const WATCHERS = /^\/(rosout|rqt_.*|rviz.*|rosbag.*|record_.*|play_.*|rostopic_.*|trundle_page.*|statistics)$/;

/** True for rqt's nodes, rviz, recorders and pages. */
export function isWatcher(node: string): boolean {
  return WATCHERS.test(node);
}
