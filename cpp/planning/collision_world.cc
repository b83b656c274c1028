#include "collision_world.h"

#include <algorithm>

namespace trundle::planning {

namespace {

bool concerns(const LinkMask* mask, const Body& body) {
  return mask == nullptr || (body.link >= 0 && (*mask)[static_cast<std::size_t>(body.link)]);
}

}  // namespace

void CollisionWorld::set_body(int number, Body body) {
  bodies_[number] = std::move(body);
  is_prepared_ = false;
}

void CollisionWorld::remove_body(int number) {
  bodies_.erase(number);
  std::erase_if(allowed_, [&](const auto& pair) { return pair.first == number || pair.second == number; });
  is_prepared_ = false;
}

void CollisionWorld::allow(int a, int b, bool is_allowed) {
  if (is_allowed) allowed_.insert(std::minmax(a, b));
  else allowed_.erase(std::minmax(a, b));
  is_prepared_ = false;
}

CollisionWorld CollisionWorld::copy(NarrowPhase narrow) const {
  CollisionWorld copied(tree_, narrow);
  copied.bodies_ = bodies_;
  copied.allowed_ = allowed_;
  return copied;
}

void CollisionWorld::prepare() {
  if (is_prepared_) return;
  movers_.clear();
  fixed_.clear();
  self_pairs_.clear();
  std::vector<Box> boxes;
  for (const auto& [number, body] : bodies_) {
    if (body.pieces.empty()) continue;
    if (body.link >= 0) {
      movers_.push_back({number, &body, std::vector<Placed>(body.pieces.size()), {}});
      continue;
    }
    for (const Piece& piece : body.pieces) {
      fixed_.push_back({number, &piece, body.padding});
      boxes.push_back(box_around(piece.pose, piece.shape->center, piece.shape->half).grown(body.padding));
    }
  }
  for (std::size_t i = 0; i < movers_.size(); ++i)
    for (std::size_t j = i + 1; j < movers_.size(); ++j)
      if (movers_[i].body->link != movers_[j].body->link && !is_allowed(movers_[i].number, movers_[j].number))
        self_pairs_.emplace_back(i, j);
  allowed_objects_.assign(movers_.size(), {});
  for (std::size_t i = 0; i < movers_.size(); ++i)
    for (const auto& [a, b] : allowed_) {
      if (a == movers_[i].number) allowed_objects_[i].insert(b);
      if (b == movers_[i].number) allowed_objects_[i].insert(a);
    }
  world_.build(boxes);
  is_prepared_ = true;
}

void CollisionWorld::place(std::span<const double> state) {
  prepare();
  tree_.compute(state, poses_);
  for (Mover& mover : movers_) {
    const Rigid& link = poses_[static_cast<std::size_t>(mover.body->link)];
    mover.box = {};
    for (std::size_t i = 0; i < mover.placed.size(); ++i) {
      const Piece& piece = mover.body->pieces[i];
      Placed& placed = mover.placed[i];
      placed.pose = link * piece.pose;
      placed.box = box_around(placed.pose, piece.shape->center, piece.shape->half).grown(mover.body->padding);
      mover.box.add(placed.box);
    }
  }
}

template <typename Reach, typename Visit>
bool CollisionWorld::visit_pairs(const LinkMask* mask, Reach reach, Visit visit) {
  for (std::size_t pair = 0; pair < self_pairs_.size(); ++pair) {
    const Mover &a = movers_[self_pairs_[pair].first], &b = movers_[self_pairs_[pair].second];
    if (!concerns(mask, *a.body) && !concerns(mask, *b.body)) continue;
    const int number = static_cast<int>(pair);
    if (a.box.distance(b.box) > reach(-1, number)) continue;
    const double padding = a.body->padding + b.body->padding;
    for (std::size_t k = 0; k < a.placed.size(); ++k) {
      if (a.placed[k].box.distance(b.box) > reach(-1, number)) continue;
      for (std::size_t l = 0; l < b.placed.size(); ++l)
        if (a.placed[k].box.distance(b.placed[l].box) <= reach(-1, number) &&
            !visit(a.number, *a.body->pieces[k].shape, a.placed[k].pose, b.number, *b.body->pieces[l].shape,
                   b.placed[l].pose, padding, reach(-1, number)))
          return false;
    }
  }
  for (std::size_t i = 0; i < movers_.size(); ++i) {
    const Mover& mover = movers_[i];
    if (!concerns(mask, *mover.body)) continue;
    const int number = static_cast<int>(i);
    for (std::size_t k = 0; k < mover.placed.size(); ++k) {
      const Placed& placed = mover.placed[k];
      const bool goes_on =
          world_.query_if([&](const Box& box) { return box.distance(placed.box) <= reach(number, -1); },
                          [&](int item) {
                            const Fixed& fixed = fixed_[static_cast<std::size_t>(item)];
                            if (!allowed_objects_[i].empty() && allowed_objects_[i].contains(fixed.number)) return true;
                            const double padding = mover.body->padding + fixed.padding;
                            return visit(mover.number, *mover.body->pieces[k].shape, placed.pose, fixed.number,
                                         *fixed.piece->shape, fixed.piece->pose, padding, reach(number, -1));
                          });
      if (!goes_on) return false;
    }
  }
  return true;
}

bool CollisionWorld::is_free(std::span<const double> state, const LinkMask* mask) {
  place(state);
  return visit_pairs(
      mask, [](int, int) { return 0.0; },
      [&](int, const ConvexShape& a, const Rigid& pose_a, int, const ConvexShape& b, const Rigid& pose_b,
          double padding, double) { return narrow_.is_apart(a, pose_a, b, pose_b, padding); });
}

bool CollisionWorld::is_free_within(std::span<const double> state, const LinkMask* mask, const MotionBounds& bounds,
                                    double scale) {
  place(state);
  return visit_pairs(
      mask,
      [&](int mover, int pair) {
        return scale * (mover >= 0 ? bounds.bodies[static_cast<std::size_t>(mover)]
                                   : bounds.pairs[static_cast<std::size_t>(pair)]);
      },
      [&](int, const ConvexShape& a, const Rigid& pose_a, int, const ConvexShape& b, const Rigid& pose_b,
          double padding, double reach) { return narrow_.is_apart(a, pose_a, b, pose_b, padding + reach); });
}

double MotionBounds::greatest() const {
  double most = 0.0;
  for (const double bound : bodies) most = std::max(most, bound);
  return most;
}

namespace {

// The way of a body's points per unit of a variable, in the frame of a link above it: the distance from each joint that
// the variable moves to the farthest point, along the links between them.
class ReachAlong {
 public:
  ReachAlong(const LinkTree& tree, std::span<const int> variables, std::span<const double> extents,
             std::span<const double> state)
      : tree_(tree), variables_(variables), extents_(extents), state_(state) {}

  double operator()(const Body& body, int above, int variable) const {
    double away = 0.0;  // of the farthest point from the link's origin
    for (const Piece& piece : body.pieces)
      away = std::max(away, norm(piece.pose * piece.shape->center) + piece.shape->radius);
    double reach = 0.0;
    for (int link = body.link; link != above && link >= 0;) {
      const TreeJoint& joint = tree_.joint(static_cast<std::size_t>(link));
      reach += rate(joint, variable, away);
      away += norm(joint.origin.p) + slide(joint);
      link = joint.parent;
    }
    return reach;
  }

 private:
  static double rate(const TreeJoint& joint, int variable, double away) {
    const int driver = joint.leader >= 0 ? joint.leader : joint.variable;
    const double factor = joint.leader >= 0 ? std::abs(joint.multiplier) : 1.0;
    switch (joint.kind) {
      case JointKind::kRevolute: return driver == variable ? factor * away : 0.0;
      case JointKind::kPrismatic: return driver == variable ? factor : 0.0;
      case JointKind::kPlanar:
        if (variable < joint.variable || variable > joint.variable + 2) return 0.0;
        return variable == joint.variable + 2 ? away : 1.0;
      case JointKind::kFloating:
        if (variable < joint.variable || variable > joint.variable + 6) return 0.0;
        return variable >= joint.variable + 3 ? 2.0 * away : 1.0;
      default: return 0.0;
    }
  }

  // Greatest distance that a joint moves its link's origin away.
  double slide(const TreeJoint& joint) const {
    const int driver = joint.leader >= 0 ? joint.leader : joint.variable;
    const double factor = joint.leader >= 0 ? std::abs(joint.multiplier) : 1.0;
    if (joint.kind == JointKind::kPrismatic) return factor * extent(driver) + std::abs(joint.offset);
    if (joint.kind == JointKind::kPlanar) return extent(joint.variable) + extent(joint.variable + 1);
    if (joint.kind == JointKind::kFloating)
      return extent(joint.variable) + extent(joint.variable + 1) + extent(joint.variable + 2);
    return 0.0;
  }

  double extent(int variable) const {
    for (std::size_t k = 0; k < variables_.size(); ++k)
      if (variables_[k] == variable) return extents_[k];
    return std::abs(state_[static_cast<std::size_t>(variable)]);
  }

  const LinkTree& tree_;
  std::span<const int> variables_;
  std::span<const double> extents_, state_;
};

}  // namespace

std::vector<MotionBounds> CollisionWorld::motion_bounds(std::span<const int> variables, std::span<const double> extents,
                                                        std::span<const double> state) {
  prepare();
  const ReachAlong reach(tree_, variables, extents, state);
  std::vector<MotionBounds> bounds(variables.size());
  for (std::size_t k = 0; k < variables.size(); ++k) {
    for (const Mover& mover : movers_) bounds[k].bodies.push_back(reach(*mover.body, -1, variables[k]));
    for (const auto& [i, j] : self_pairs_) {
      const Body &a = *movers_[i].body, &b = *movers_[j].body;
      int above = a.link;  // nearest link above both
      while (above >= 0 && !tree_.is_below(b.link, above)) above = tree_.joint(static_cast<std::size_t>(above)).parent;
      bounds[k].pairs.push_back(reach(a, above, variables[k]) + reach(b, above, variables[k]));
    }
  }
  return bounds;
}

std::vector<BodyContact> CollisionWorld::contacts(std::span<const double> state, const LinkMask* mask,
                                                  std::size_t max_count, std::size_t max_per_pair) {
  place(state);
  std::vector<BodyContact> found;
  std::map<std::pair<int, int>, std::size_t> counts;
  visit_pairs(
      mask, [](int, int) { return 0.0; },
      [&](int number_a, const ConvexShape& a, const Rigid& pose_a, int number_b, const ConvexShape& b,
          const Rigid& pose_b, double padding, double) {
        if (found.size() >= max_count) return false;
        std::size_t& count = counts[{number_a, number_b}];
        if (count >= max_per_pair) return true;
        BodyContact contact{number_a, number_b, 0.0, {}, {}};
        Vec3 on_a, on_b;
        const double away = narrow_.distance(a, pose_a, b, pose_b, padding + 1e-9, &on_a, &on_b);
        if (away > padding) return true;
        ++count;
        contact.depth = padding - away;
        contact.position = 0.5 * (on_a + on_b);
        Vec3 normal = away >= 0.0 ? on_b - on_a : on_a - on_b;
        if (norm(normal) < 1e-12) normal = pose_b * b.center - pose_a * a.center;
        const double length = norm(normal);
        contact.normal = length > 1e-12 ? (1.0 / length) * normal : Vec3{0, 0, 1};
        found.push_back(contact);
        return true;
      });
  return found;
}

NearestBodies CollisionWorld::nearest(std::span<const double> state, const LinkMask* mask, double cutoff) {
  place(state);
  NearestBodies best;
  best.distance = cutoff;
  visit_pairs(
      mask, [&](int, int) { return std::max(best.distance, 0.0); },
      [&](int number_a, const ConvexShape& a, const Rigid& pose_a, int number_b, const ConvexShape& b,
          const Rigid& pose_b, double padding, double) {
        Vec3 on_a, on_b;
        const double reach = std::max(best.distance, 0.0) + padding;
        const double away = narrow_.distance(a, pose_a, b, pose_b, reach, &on_a, &on_b) - padding;
        if (away < best.distance) best = {away, number_a, number_b, on_a, on_b};
        return true;
      });
  return best;
}

std::vector<BodyContact> CollisionWorld::touching(std::span<const double> state, const ConvexShape& shape,
                                                  const Rigid& pose) {
  place(state);
  std::vector<BodyContact> found;
  const Box box = box_around(pose, shape.center, shape.half);
  for (const Mover& mover : movers_) {
    for (std::size_t k = 0; k < mover.placed.size(); ++k) {
      if (!mover.placed[k].box.overlaps(box)) continue;
      const ConvexShape& piece = *mover.body->pieces[k].shape;
      if (narrow_.is_apart(piece, mover.placed[k].pose, shape, pose, mover.body->padding)) continue;
      found.push_back({mover.number, -1, 0.0, pose * shape.center, {}});
      break;
    }
  }
  return found;
}

}  // namespace trundle::planning
