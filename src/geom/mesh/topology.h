// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Topology: which faces of a mesh meet at which edges, and what follows from it. Half-edges are
// named by the corner they start at. Vertices are one where faces share the position index; merge
// positions first (mesh/cleanup.h) where they only coincide. Built in O(n log n), questions are
// O(1) unless said otherwise. Angles are in degrees. The mesh must outlive the topology unchanged.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geom/mesh/mesh.h"

namespace gable {

class Topology {
 public:
  static constexpr uint32_t kNone = 0xffffffff;

  explicit Topology(const Mesh& m);

  size_t edgeCount() const { return edgeStarts_.size() - 1; }
  /// The half-edges of an edge, in the order of corners.
  std::span<const uint32_t> usesOf(uint32_t edge) const {
    return {uses_.data() + edgeStarts_[edge], edgeStarts_[edge + 1] - edgeStarts_[edge]};
  }
  uint32_t edgeOf(uint32_t corner) const { return edgeOf_[corner]; }
  uint32_t faceOf(uint32_t corner) const { return faceOf_[corner]; }
  uint32_t next(uint32_t corner) const { return next_[corner]; }
  uint32_t previous(uint32_t corner) const { return previous_[corner]; }
  /// The half-edge of the other face, running the other way; kNone at boundaries, and where more
  /// than two faces meet or two run the same way.
  uint32_t twin(uint32_t corner) const { return twin_[corner]; }
  /// Met by one face only.
  bool isBoundary(uint32_t edge) const { return usesOf(edge).size() == 1; }
  /// At least one face, and every edge belongs to exactly two faces.
  bool closed() const { return closed_; }

  /// Parts that share no position: for each face its part, numbered in the order of faces.
  const std::vector<uint32_t>& components() const { return component_; }
  size_t componentCount() const { return componentClosed_.size(); }
  /// Every edge of the part is used as often one way as the other, so it encloses a volume.
  bool componentEncloses(uint32_t component) const { return componentClosed_[component]; }

  /// Angle between the normals of the two faces at an edge, 0 where they are coplanar; positive
  /// where the edge is convex, negative where it is concave, 0 where there is no pair of faces.
  double dihedralAngle(uint32_t edge) const;

 private:
  void linkCorners();
  void findEdges();
  void findTwins();
  void findComponents();

  const Mesh& mesh_;
  std::vector<uint32_t> faceOf_, next_, previous_, twin_, edgeOf_;
  std::vector<uint32_t> edgeStarts_{0}, uses_;
  std::vector<uint32_t> component_;
  std::vector<bool> componentClosed_;
  bool closed_ = false;
};

/// Of a mesh whose components enclose something; open parts add what their cone from the first
/// position holds. O(n).
double volume(const Mesh& m);
/// The sum of the lengths of all edges that only one face uses. O(n log n).
double boundaryLength(const Mesh& m);
size_t holeCount(const Mesh& m);
size_t edgeCount(const Mesh& m);

/// A reflex corner of an outer loop by more than a hundredth of a degree, or a hole.
bool isConcave(const Mesh& m, size_t face);
bool isConcave(const Mesh& m);
/// No local normal (of two successive edges) is further from the face's than `tolerance` degrees.
bool isPlanar(const Mesh& m, size_t face, double tolerance);
bool isPlanar(const Mesh& m, double tolerance);
/// Four corners, no holes, all angles within `tolerance` degrees of a right one.
bool isRectangular(const Mesh& m, size_t face, double tolerance);
bool isRectangular(const Mesh& m, double tolerance);

/// For each position the normalised sum of the normals of its faces, weighted by the angle of the
/// face there; zero where no face with an area uses it. O(n).
std::vector<Vec3> vertexNormals(const Mesh& m);

/// Sets corner normals: faces around a position are averaged unless an edge between them is as
/// sharp as `angle` degrees or sharper (0: all hard, 180: all soft, mostly).
void softenNormals(Mesh& m, double angle);

}  // namespace gable
