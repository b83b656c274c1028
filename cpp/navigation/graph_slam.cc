#include "graph_slam.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "symmetric_solve.h"

namespace trundle::navigation {

namespace {

constexpr std::size_t kMaxChain = 40;                       // scans in the window of a link or a loop
constexpr std::size_t kMaxLoopChains = 3;                   // searched per scan
constexpr double kMaxReach = 25.0;                          // of hits that are matched [m]
constexpr double kMargin = 0.5;                             // of a window beyond the scan [m]
constexpr int kNodesPerLink = 200;                          // a graph is optimized once a link for so many nodes is new
constexpr double kRedrawn = 0.002, kRedrawnAngle = 0.0005;  // moves of a node after which the map is redrawn [m], [rad]
// A loop may raise the error by what its three numbers may, and by as much for each step as odometry that is wrong by
// 0.7 of its standard deviation in one direction.
constexpr double kLoopError = 16.0, kLoopErrorPerStep = 0.5;

constexpr std::array<double, 6> kLost{1.0, 0.0, 1.0, 0.0, 0.0, 1.0};  // information on the pose of a lost robot

std::size_t index(int i) { return static_cast<std::size_t>(i); }

double distance(const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Highest standard deviation of the place that an information matrix leaves [m].
double deviation(const std::array<double, 6>& information) {
  const auto covariance = symmetric_inverse(information);
  const double middle = 0.5 * (covariance[0] + covariance[2]);
  const double spread = std::hypot(0.5 * (covariance[0] - covariance[2]), covariance[1]);
  const double highest = middle + spread;
  return std::isfinite(highest) && highest >= 0.0 ? std::sqrt(highest) : std::numeric_limits<double>::infinity();
}

std::array<double, 6> sum(const std::array<double, 6>& a, const std::array<double, 6>& b) {
  std::array<double, 6> total;
  for (std::size_t i = 0; i < total.size(); ++i) total[i] = a[i] + b[i];
  return total;
}

// Search about the best pose of a coarser one, in cells of a size [m].
SearchOptions fine(const SearchOptions& coarse, double resolution) {
  SearchOptions fine{2.0 * resolution, coarse.angle_step, coarse.fine_angle_step, coarse.fine_angle_step};
  fine.is_penalized = false;
  return fine;
}

// Pose of what was at `was` in the frame that moved from `from` to `to`.
PlanarPose carried(const PlanarPose& was, const PlanarPose& from, const PlanarPose& to) {
  return compose(to, compose(inverse(from), was));
}

}  // namespace

GraphSlam::GraphSlam(const GraphOptions& options) : options_(options), counts_(options.resolution) {}

bool GraphSlam::process(const PlanarPose& motion, double time_s, RangeScan scan) {
  pose_ = compose(pose_, motion);
  for (Motion* since : {&since_match_, &since_node_}) {
    since->distance += std::hypot(motion.x, motion.y);
    since->angle += std::abs(motion.yaw);
  }
  const bool has_map = !graph_.poses.empty();
  const bool is_used = !has_map || is_due(time_s) || is_lost_;
  if (!is_used && !options_.matches_all) return false;
  if (has_map && options_.matches_scans) match(scan);
  if (!is_used) return false;
  if (options_.extends_map) add_node(std::move(scan));
  last_time_s_ = time_s;
  used_pose_ = pose_;
  since_node_ = {};
  is_lost_ = false;
  return true;
}

void GraphSlam::set_pose(const PlanarPose& pose) {
  pose_ = used_pose_ = pose;
  is_lost_ = !graph_.poses.empty();
}

bool GraphSlam::is_due(double time_s) const {
  const double elapsed = time_s - last_time_s_;
  if (elapsed >= options_.longest_time || elapsed < 0.0) return true;
  if (elapsed < options_.least_time) return false;
  const PlanarPose moved = compose(inverse(used_pose_), pose_);
  return std::hypot(moved.x, moved.y) >= options_.least_distance || std::abs(moved.yaw) >= options_.least_angle;
}

// Place of a scan, in the map.
Point GraphSlam::place(int node) const {
  const PlanarPose& pose = graph_.poses[index(node)];
  return options_.uses_center ? Placement(pose)(centers_[index(node)]) : Point{pose.x, pose.y};
}

// The scans before, as far as they are near; those of the map where it is not extended, or none is near.
GraphSlam::Chain GraphSlam::running() const {
  const int count = static_cast<int>(graph_.poses.size());
  Chain all, recent;
  for (int node = 0; node < count; ++node) {
    const PlanarPose& pose = graph_.poses[index(node)];
    if (std::hypot(pose.x - pose_.x, pose.y - pose_.y) > options_.running_distance) continue;
    all.push_back(node);
    if (node >= count - options_.running_scans) recent.push_back(node);
  }
  return recent.empty() || !options_.extends_map || is_lost_ ? nearest(std::move(all)) : recent;
}

// The scans of a chain that are nearest to the robot.
GraphSlam::Chain GraphSlam::nearest(Chain chain) const {
  if (chain.size() <= kMaxChain) return chain;
  const auto from_robot = [&](int node) {
    return std::hypot(graph_.poses[index(node)].x - pose_.x, graph_.poses[index(node)].y - pose_.y);
  };
  std::stable_sort(chain.begin(), chain.end(), [&](int a, int b) { return from_robot(a) < from_robot(b); });
  chain.resize(kMaxChain);
  return chain;
}

// A window with the surfaces that a chain's scans hit; without those that are seen from the other side.
ScoreWindow GraphSlam::window(const Chain& chain, const PlanarPose& viewpoint, double half_width, double resolution,
                              double smear) const {
  ScoreWindow window({viewpoint.x, viewpoint.y}, half_width, resolution, smear);
  for (const int node : chain) {
    const Placement place(graph_.poses[index(node)]);
    const RangeScan& scan = scans_[index(node)];
    for (std::size_t i = 0; i < scan.hits.size(); ++i) {
      const Point hit = place(scan.hits[i]), normal = place.turn(scan.normals[i]);
      if (normal.x * (viewpoint.x - hit.x) + normal.y * (viewpoint.y - hit.y) < 0.0) continue;
      window.add(hit);
      // Between two hits of one surface, too: else scans would be drawn to where the beams of others end.
      if (i + 1 < scan.hits.size() && is_one_surface(scan, i)) window.add_between(hit, place(scan.hits[i + 1]));
    }
  }
  window.finish();
  return window;
}

std::array<double, 6> GraphSlam::odometry_information(const Motion& motion) const {
  const double linear = options_.still_linear_noise + options_.linear_noise * motion.distance;
  const double angular = options_.still_angular_noise + options_.angular_noise * motion.angle +
                         options_.turn_per_distance * motion.distance;
  return {1.0 / (linear * linear), 0.0, 1.0 / (linear * linear), 0.0, 0.0, 1.0 / (angular * angular)};
}

// Searches for the scan about the robot as for a loop.
void GraphSlam::find(const RangeScan& scan) {
  const double half = std::min(scan.reach(), kMaxReach) + options_.loop_search.half_width + kMargin;
  const ScoreWindow coarse =
      window(running(), pose_, half, options_.loop_window_resolution, options_.loop_window_smear);
  const ScanMatch found = search(coarse, scan, pose_, options_.loop_search);
  if (found.response >= options_.loop_response_coarse) pose_ = found.pose;
}

// Corrects the predicted pose by a match with the scans before, each by its information.
void GraphSlam::match(const RangeScan& scan) {
  if (is_lost_) find(scan);
  const double half = std::min(scan.reach(), kMaxReach) + options_.search.half_width + kMargin;
  const ScoreWindow near = window(running(), pose_, half, options_.window_resolution, options_.window_smear);
  ScanMatch match = search(near, scan, pose_, options_.search);
  match = refine(near, scan, search(near, scan, match.pose, fine(options_.search, near.resolution())).pose);
  const auto& information = match.information;
  covariance_ = symmetric_inverse(sum(information, is_lost_ ? kLost : odometry_information(since_match_)));
  const std::array<double, 3> correction{match.pose.x - pose_.x, match.pose.y - pose_.y,
                                         angle_difference(match.pose.yaw, pose_.yaw)};
  const auto [x, y, yaw] = symmetric_product(covariance_, symmetric_product(information, correction));
  if (std::isfinite(x + y + yaw)) pose_ = {pose_.x + x, pose_.y + y, normalized_angle(pose_.yaw + yaw)};
  response_ = match.response;
  match_information_ = information;
  since_match_ = {};
}

void GraphSlam::add_node(RangeScan scan) {
  const int node = static_cast<int>(graph_.poses.size());
  if (node > 0) {
    int from = node - 1;
    if (is_lost_) from = nearest(running()).front();
    const PlanarPose& last = graph_.poses[index(from)];
    const auto information = is_lost_ ? match_information_ : sum(match_information_, odometry_information(since_node_));
    graph_.constraints.push_back({from, node, compose(inverse(last), pose_), turned(information, -last.yaw)});
  }
  graph_.poses.push_back(pose_);
  centers_.push_back(scan.center());
  scans_.push_back(std::move(scan));
  if (!options_.matches_scans || node == 0) return;
  const std::vector<bool> is_linked = linked_nearby();
  link_nearby(is_linked);
  if (options_.closes_loops) close_loop(is_linked);
}

// Runs of consecutive nodes.
std::vector<GraphSlam::Chain> GraphSlam::chains(const std::vector<bool>& is_candidate) const {
  std::vector<Chain> chains;
  for (std::size_t node = 0; node < is_candidate.size(); ++node) {
    if (!is_candidate[node]) continue;
    if (node == 0 || !is_candidate[node - 1]) chains.emplace_back();
    chains.back().push_back(static_cast<int>(node));
  }
  std::erase_if(chains, [&](const Chain& chain) { return static_cast<int>(chain.size()) < options_.loop_chain; });
  return chains;
}

// Nodes that constraints between scans nearby connect with the last one.
std::vector<bool> GraphSlam::linked_nearby() const {
  const std::size_t count = graph_.poses.size();
  std::vector<std::vector<int>> neighbors(count);
  for (const Constraint& constraint : graph_.constraints) {
    neighbors[index(constraint.from)].push_back(constraint.to);
    neighbors[index(constraint.to)].push_back(constraint.from);
  }
  const int last = static_cast<int>(count) - 1;
  const Point here = place(last);
  std::vector<bool> is_linked(count, false);
  std::queue<int> queue({last});
  is_linked.back() = true;
  for (; !queue.empty(); queue.pop())
    for (const int next : neighbors[index(queue.front())]) {
      if (is_linked[index(next)] || distance(place(next), here) > options_.link_distance) continue;
      is_linked[index(next)] = true;
      queue.push(next);
    }
  return is_linked;
}

Constraint GraphSlam::constraint_to(const Chain& chain, const ScanMatch& match) const {
  const auto from_match = [&](int node) {
    return std::hypot(graph_.poses[index(node)].x - match.pose.x, graph_.poses[index(node)].y - match.pose.y);
  };
  const int from =
      *std::min_element(chain.begin(), chain.end(), [&](int a, int b) { return from_match(a) < from_match(b); });
  const PlanarPose& pose = graph_.poses[index(from)];
  return {from, static_cast<int>(graph_.poses.size()) - 1, compose(inverse(pose), match.pose),
          turned(match.information, -pose.yaw)};
}

// Matches the last scan with the older chains that are linked with it.
void GraphSlam::link_nearby(const std::vector<bool>& is_linked) {
  std::vector<bool> is_older = is_linked;
  const std::size_t count = is_older.size();
  for (std::size_t node = count - std::min(count, index(options_.running_scans) + 1); node < count; ++node)
    is_older[node] = false;
  const RangeScan& scan = scans_.back();
  const double half = std::min(scan.reach(), kMaxReach) + options_.search.half_width + kMargin;
  for (const Chain& whole : chains(is_older)) {
    const Chain chain = nearest(whole);
    const ScoreWindow near = window(chain, pose_, half, options_.window_resolution, options_.window_smear);
    const ScanMatch match = refine(near, scan, search(near, scan, pose_, options_.search).pose);
    if (match.response < options_.link_response || !std::isfinite(deviation(match.information))) continue;
    graph_.constraints.push_back(constraint_to(chain, match));
    ++pending_links_;
  }
  if (pending_links_ > static_cast<int>(graph_.poses.size()) / kNodesPerLink) optimize();
}

// Matches the last scan with chains that are near, though nothing links them yet; closes the first loop found.
void GraphSlam::close_loop(const std::vector<bool>& is_linked) {
  std::vector<bool> is_candidate(is_linked.size());
  const Point here = place(static_cast<int>(is_linked.size()) - 1);
  for (std::size_t node = 0; node < is_linked.size(); ++node)
    is_candidate[node] = !is_linked[node] && distance(place(static_cast<int>(node)), here) <= options_.loop_distance;
  const RangeScan& scan = scans_.back();
  const double reach = std::min(scan.reach(), kMaxReach) + kMargin;
  std::size_t searched = 0;
  for (const Chain& whole : chains(is_candidate)) {
    if (++searched > kMaxLoopChains) return;
    const Chain chain = nearest(whole);
    const double half = reach + options_.loop_search.half_width;
    const ScoreWindow coarse = window(chain, pose_, half, options_.loop_window_resolution, options_.loop_window_smear);
    ScanMatch match = search(coarse, scan, pose_, options_.loop_search);
    if (match.response < options_.loop_response_coarse) continue;
    const SearchOptions nearby = fine(options_.loop_search, options_.loop_window_resolution);
    const ScoreWindow near =
        window(chain, match.pose, reach + nearby.half_width, options_.window_resolution, options_.window_smear);
    match = refine(near, scan, search(near, scan, match.pose, nearby).pose);
    if (match.response < options_.loop_response_fine) continue;
    if (!(deviation(match.information) <= options_.loop_deviation)) continue;
    if (accept_loop(constraint_to(chain, match))) return;
  }
}

// Optimizes with a loop; refuses it where the graph would have to bend more than its uncertainty allows.
bool GraphSlam::accept_loop(const Constraint& constraint) {
  if (pending_links_ > 0) optimize();
  const double before = graph_.error();
  const std::vector<PlanarPose> poses = graph_.poses;
  graph_.constraints.push_back(constraint);
  const double after = graph_.optimize();
  if (after - before > kLoopError + kLoopErrorPerStep * std::abs(constraint.to - constraint.from)) {
    graph_.constraints.pop_back();
    graph_.poses = poses;
    ++refused_loops_;
    return false;
  }
  move(poses.back());
  ++loops_;
  return true;
}

void GraphSlam::optimize() {
  const PlanarPose last = graph_.poses.back();
  graph_.optimize();
  move(last);
  pending_links_ = 0;
}

// Moves the robot with the last node, which was elsewhere.
void GraphSlam::move(const PlanarPose& last) {
  pose_ = carried(pose_, last, graph_.poses.back());
  correction_ = carried(correction_, last, graph_.poses.back());
}

void GraphSlam::restore(PoseGraph graph, std::vector<RangeScan> scans) {
  graph_ = std::move(graph);
  scans_ = std::move(scans);
  centers_.clear();
  for (const RangeScan& scan : scans_) centers_.push_back(scan.center());
  counts_ = CellCounts(options_.resolution);
  counted_.clear();
  pending_links_ = 0;
  since_match_ = since_node_ = {};
}

// Counts the scans that are not yet drawn; all of them, where one was moved.
void GraphSlam::count_new() {
  const auto has_moved = [&](std::size_t node) {
    const PlanarPose &was = counted_[node], &is = graph_.poses[node];
    return std::hypot(is.x - was.x, is.y - was.y) > kRedrawn ||
           std::abs(angle_difference(is.yaw, was.yaw)) > kRedrawnAngle;
  };
  for (std::size_t node = 0; node < counted_.size(); ++node) {
    if (!has_moved(node)) continue;
    counts_ = CellCounts(options_.resolution);
    counted_.clear();
  }
  for (std::size_t node = counted_.size(); node < scans_.size(); ++node) {
    const PlanarPose& pose = graph_.poses[node];
    const Placement place(pose);
    const Point origin = place(scans_[node].origin);
    for (const auto* ends : {&scans_[node].hits, &scans_[node].misses})
      for (const Point& end : *ends) {
        const Point to = place(end);
        const double length = distance(origin, to);
        if (!(length > 0.0)) continue;
        counts_.add({origin.x, origin.y, (to.x - origin.x) / length, (to.y - origin.y) / length}, length,
                    ends == &scans_[node].hits);
      }
    counted_.push_back(pose);
  }
}

SeenCells GraphSlam::seen() {
  count_new();
  return counts_.seen();
}

std::vector<std::int8_t> GraphSlam::draw(const MapFrame& frame) {
  count_new();
  return counts_.draw(frame);
}

}  // namespace trundle::navigation
