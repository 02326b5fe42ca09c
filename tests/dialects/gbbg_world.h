// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// GBBG's boxes and rules in its own left-handed frame, written down straight from what is known of
// the original, so that the dialect's mirrored lowering can be held against it. Slow and plain.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace gbbg_world {

using Vec = std::array<double, 3>;

inline Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec operator*(const Vec& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

/// Columns are the images of the axes.
struct Rotation {
  std::array<Vec, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vec operator()(const Vec& v) const { return axes[0] * v[0] + axes[1] * v[1] + axes[2] * v[2]; }
  Rotation operator*(const Rotation& inner) const {
    return {{(*this)(inner.axes[0]), (*this)(inner.axes[1]), (*this)(inner.axes[2])}};
  }
  Rotation inverse() const;
};

/// About one axis; the formulas are those of a right-handed frame, and in a left-handed one they
/// turn the other way round, as Unity's do.
Rotation turned(int axis, double degrees);
/// Unity's Euler angles: about z, then x, then y, each fixed.
Rotation euler(const Vec& degrees);

struct Box {
  std::string symbol;
  /// The root: the least corner.
  Vec root{};
  Rotation rotation;
  Vec size{};
};

/// A part of a box, in its axes.
Box part(const Box& b, const Vec& from, const Vec& size, const std::string& symbol);

/// The same box with another corner as root: its axes turned about one of them by quarters.
Box rerooted(const Box& b, int axis, int quarters);

struct ScopeChange {
  bool on = false;
  Vec value{};
  bool set = false, world = false, relative = false;
};
Box scopeRule(Box b, const ScopeChange& t, const ScopeChange& r, const ScopeChange& s,
              const Box& root);
std::vector<Box> splitRule(const Box& b, int axis, std::vector<double> widths, bool toRoot,
                           const std::vector<std::string>& symbols);
/// Preferred sizes of the successor.
std::vector<Box> repeatRule(const Box& b, int axis, const Vec& preferred,
                            const std::string& symbol);
std::vector<Box> gridRule(const Box& b, int axis, const Vec& preferred, const std::string& symbol);
enum class Facing { Default, Out, In };
std::vector<Box> marginRule(const Box& b, int axis, bool relative, double m, Facing facing,
                            bool center);
/// Sides, top and bottom; named so.
std::vector<Box> componentRule(const Box& b, int axis);

}  // namespace gbbg_world
