// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Slicer: the state of one cutting job, internal to mesh/clip. It owns the growing tables of points
// and of corner attributes that the parts refer to, and is the host of region/cut.h.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "geom/mesh/clip.h"
#include "geom/region/cut.h"

namespace gable::slicing {

/// A finished piece: a face in terms of the slicer's tables.
struct Piece {
  cut::Face face;
  uint32_t source = MeshPart::kNone;
};

class Slicer : public cut::Host {
 public:
  /// Values at the corners. `axis` 0..2 makes new points exact in that coordinate; -1 for none.
  /// `direction` is the gradient of the values, zero where it differs from face to face. Values
  /// nearer to a cut than `tolerance` lie on it; a share of the extent is the least that is used.
  Slicer(const Mesh& m, std::vector<double> cornerValues, int axis, const Vec3& direction,
         double tolerance);

  /// Pieces of each slab, in the order of faces.
  std::vector<std::vector<Piece>> slice(std::span<const double> cuts);
  /// Adds caps to both sides of each cut.
  void cap(std::span<const double> cuts, std::vector<std::vector<Piece>>& slabs);
  MeshPart build(const std::vector<Piece>& pieces, const CutOptions& options) const;

  int side(const cut::Corner& c) const override;
  Vec2 place(const cut::Corner& c) const override;
  cut::Corner split(const cut::Corner& a, const cut::Corner& b) override;

 private:
  struct NewPoint {
    uint32_t low, high;
    double t;
    uint32_t point;
  };
  struct CapEdge {
    uint32_t from, to;
  };

  void measureTolerance(double least);
  void collapseShortEdges();
  void sliceFace(uint32_t face, std::span<const double> cuts,
                 std::vector<std::vector<Piece>>& slabs);
  void sliceEdge(uint32_t face, std::span<const double> cuts, size_t firstCut, size_t lastCut,
                 std::vector<std::vector<Piece>>& slabs);
  void setPlane(uint32_t face);
  Vec3 gradientOf(uint32_t face, const Vec3& normal) const;
  std::span<const MeshLoop> loopsThatCount(uint32_t face) const;
  cut::Face faceOf(uint32_t face) const;
  bool onCut(uint32_t attributes) const;
  uint32_t pointOn(const cut::Corner& a, const cut::Corner& b);
  uint32_t interpolate(uint32_t a, uint32_t b, double t);
  std::vector<CapEdge> openEdges(const std::vector<Piece>& pieces,
                                 const std::vector<bool>& closed) const;
  std::vector<cut::Loop> linkLoops(const std::vector<CapEdge>& edges, uint32_t attributes) const;
  void capSide(const std::vector<bool>& closed, const Vec3& normal, std::vector<Piece>& pieces);
  void giveNotes(const std::vector<Piece>& pieces, std::vector<cut::Face>& caps);

  const Mesh& mesh_;
  int axis_;
  Vec3 direction_;
  double tolerance_ = 0;
  double cut_ = 0;
  // The plane of the face in work: directions along the cuts and up the field.
  Vec3 origin_, along_, up_;
  // By point.
  std::vector<Vec3> points_;
  // By input position: the point that stands for it.
  std::vector<uint32_t> standIn_;
  // By attribute number; corners of the input come first.
  std::vector<double> values_;
  std::vector<std::vector<Vec2>> sets_;
  std::vector<Vec3> normals_;
  std::unordered_multimap<uint64_t, NewPoint> edgePoints_;
};

/// For each face whether its component (faces that share positions) encloses a volume.
std::vector<bool> facesOfClosedComponents(const Mesh& m);

}  // namespace gable::slicing
