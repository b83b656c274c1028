// Collisions of a robot, of what it carries and of the objects around it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "box_tree.h"
#include "convex_shape.h"
#include "link_tree.h"
#include "narrow_phase.h"

namespace trundle::planning {

struct Piece {
  std::shared_ptr<const ConvexShape> shape;
  Rigid pose;  // in the frame of its body: the link's, or the model's
};

struct Body {
  int link = -1;  // link that carries it; -1: an object of the world
  double padding = 0.0;
  std::vector<Piece> pieces;
};

struct BodyContact {
  int a = 0, b = 0;  // numbers of the bodies
  double depth = 0.0;
  Vec3 position;  // in the middle of the overlap, model frame
  Vec3 normal;    // unit, from a to b
};

struct NearestBodies {
  double distance = std::numeric_limits<double>::infinity();
  int a = -1, b = -1;
  Vec3 on_a, on_b;
};

// How far points move, at most, in a motion [m]: those of each body that moves in the model frame, and those of two
// such bodies relative to each other.
struct MotionBounds {
  std::vector<double> bodies, pairs;

  double greatest() const;
};

// Which bodies a check is about: with links, contacts of bodies that one of them carries; without, all.
using LinkMask = std::vector<bool>;

class CollisionWorld {
 public:
  CollisionWorld(LinkTree tree, NarrowPhase narrow) : tree_(std::move(tree)), narrow_(narrow) {}

  // The same bodies for another thread, with a narrow phase of its own.
  CollisionWorld copy(NarrowPhase narrow) const;

  const LinkTree& tree() const { return tree_; }
  const std::map<int, Body>& bodies() const { return bodies_; }

  void set_body(int number, Body body);
  void remove_body(int number);
  // Contacts of two bodies are allowed, or count.
  void allow(int a, int b, bool is_allowed);

  bool is_free(std::span<const double> state, const LinkMask* mask);
  // True if no motion of some bounds, scaled, from a state can touch anything.
  bool is_free_within(std::span<const double> state, const LinkMask* mask, const MotionBounds& bounds, double scale);
  // Bounds of the motion per unit of each of some variables; `extents` are their greatest absolute values.
  std::vector<MotionBounds> motion_bounds(std::span<const int> variables, std::span<const double> extents,
                                          std::span<const double> state);
  std::vector<BodyContact> contacts(std::span<const double> state, const LinkMask* mask, std::size_t max_count,
                                    std::size_t max_per_pair);
  // Nearest pair of bodies that may not touch, up to a cutoff; negative: the greatest depth.
  NearestBodies nearest(std::span<const double> state, const LinkMask* mask, double cutoff);
  // Contacts of one more convex shape with the links and what they carry.
  std::vector<BodyContact> touching(std::span<const double> state, const ConvexShape& shape, const Rigid& pose);

  // Poses of the links as of the last state.
  const std::vector<Rigid>& link_poses() const { return poses_; }

 private:
  struct Placed {  // piece of a body that moves
    Rigid pose;
    Box box;
  };
  struct Mover {
    int number;
    const Body* body;
    std::vector<Placed> placed;
    Box box;
  };
  struct Fixed {  // piece of the world
    int number;
    const Piece* piece;
    double padding;
  };

  void prepare();
  void place(std::span<const double> state);
  bool is_allowed(int a, int b) const { return allowed_.contains(std::minmax(a, b)); }

  // Call visit(number a, piece a, pose a, number b, piece b, pose b, padding, reach) for all pairs whose boxes are
  // within reach(mover, pair) [m], one of which is -1; stop when it returns false.
  template <typename Reach, typename Visit>
  bool visit_pairs(const LinkMask* mask, Reach reach, Visit visit);

  LinkTree tree_;
  NarrowPhase narrow_;
  std::map<int, Body> bodies_;
  std::set<std::pair<int, int>> allowed_;
  bool is_prepared_ = false;
  std::vector<Mover> movers_;
  std::vector<std::pair<std::size_t, std::size_t>> self_pairs_;
  std::vector<std::set<int>> allowed_objects_;  // per mover
  std::vector<Fixed> fixed_;
  BoxTree world_;
  std::vector<Rigid> poses_;
};

}  // namespace trundle::planning
