// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The wavefront of Aichholzer and Aurenhammer (1996) as an event simulation. Edge events: an edge
// shrinks to a point. Split events: a reflex vertex runs into an edge. Because planes.h answers
// exactly and lets no four planes meet, these two are all there is, but for planes that are equal
// or parallel, which no perturbation parts; Kelly and Wonka (2011) call their cases generalised
// intersections. They are settled at once, in settle(): neighbours of one plane become one edge, an
// edge between two edges of one plane has no length and goes, and where antiparallel neighbours
// coincide, the vertex between them runs along them to the nearer end.
//
// Split candidates follow Felkel and Obdrzalek (1998), but a candidate is a pair of vertex and
// plane, and whether an edge of that plane is there is asked of the wavefront as it is when its
// time comes. Each reflex vertex takes its candidates from the planes in batches, earliest first.
#include "geom/skeleton/wavefront.h"

#include <algorithm>
#include <cmath>

#include "base/work.h"

namespace gable::skeleton {

namespace {

struct WaveVertex {
  uint32_t left = kNone, right = kNone;
  uint32_t startNode = kNone;
  uint32_t batch = 8;
  bool alive = true;
};

struct WaveEdge {
  PlaneId plane = 0;
  uint32_t face = 0;
  uint32_t tail = kNone, head = kNone;
  uint32_t version = 0;
  bool alive = true;
};

enum class EventKind : uint8_t { Collapse, Split, MoreCandidates };

struct Event {
  EventTime time;
  EventKind kind = EventKind::Collapse;
  uint32_t subject = 0;
  /// The edge's version, or the plane of a split.
  uint32_t detail = 0;
  /// Index into the memo of exact times.
  uint32_t memo = kNone;
};

// Candidates so late (grid units; the extent is 2^51) hardly ever come up: a vertex and a plane
// that run along with each other. They wait until nothing else is left.
constexpr double kLate = 0x1p60;

// Edges of weight nothing move by 2^-63, so what only they bound is closed after more than this.
constexpr double kNever = 0x1p95;

/// A plane that a reflex vertex may run into, and not before `low`.
struct Candidate {
  double low = 0;
  bool late = false;
  EventTime time;
};

// Candidates are found with bounds twice as wide as those of planes.h, for the order of summation.
constexpr double kCandidateRounding = 0x1p-46;

class Simulation {
 public:
  Simulation(const Planes& planes, uint32_t top, Trace& trace)
      : planes_(planes), top_(top), trace_(trace), fragments_(planes.size()) {}

  void addRing(const std::vector<WaveInput>& ring);
  WaveEnd run();

 private:
  uint32_t prevId(uint32_t e) const { return vertices_[edges_[e].tail].left; }
  uint32_t nextId(uint32_t e) const { return vertices_[edges_[e].head].right; }
  PlaneId planeOf(uint32_t e) const { return edges_[e].plane; }

  uint32_t newEdge(PlaneId plane, uint32_t face);
  uint32_t newVertex(uint32_t left, uint32_t right, uint32_t node);
  uint32_t newNode(PlaneId p, PlaneId q, PlaneId r);
  void endVertex(uint32_t v, uint32_t node);
  void killEdge(uint32_t e);

  void collapse(uint32_t e, uint32_t node);
  void split(uint32_t v, uint32_t e);
  void settle(uint32_t v);
  bool finishPair(uint32_t v);
  void mergeAcross(uint32_t v);
  void runAlong(uint32_t v);
  void schedule(uint32_t v);
  void scheduleCollapse(uint32_t e);
  void findCandidates(uint32_t v, const EventTime* after);
  bool evaluate(Candidate& c) const;
  void scheduleSplits(uint32_t v, const EventTime* after);
  uint32_t struckEdge(uint32_t v, PlaneId plane) const;
  void capAll();

  void push(Event e);
  uint32_t pop();
  bool later(uint32_t a, uint32_t b);
  const ExactTime& exactOf(Event& e);
  ExactTime exactLevel(double value) const;
  int compareEvents(Event& a, Event& b);
  bool isPast(const EventTime& t);

  const Planes& planes_;
  uint32_t top_;
  Trace& trace_;
  std::vector<WaveVertex> vertices_;
  std::vector<WaveEdge> edges_;
  std::vector<std::vector<uint32_t>> fragments_;
  std::vector<PlaneId> livePlanes_;
  std::vector<Event> events_;
  std::vector<uint32_t> heap_;
  std::vector<ExactTime> memo_;
  std::vector<Candidate> candidates_;
  Event now_;
  bool started_ = false;
  bool stuck_ = false;
  size_t aliveEdges_ = 0;
  size_t steps_ = 0;
};

// Events in the order of exact time, then of making.

const ExactTime& Simulation::exactOf(Event& e) {
  if (e.memo == kNone) {
    e.memo = static_cast<uint32_t>(memo_.size());
    memo_.push_back(e.kind == EventKind::MoreCandidates ? exactLevel(e.time.value)
                                                        : planes_.exact(e.time));
  }
  return memo_[e.memo];
}

ExactTime Simulation::exactLevel(double value) const {
  int exponent = 0;
  const double m = std::frexp(value, &exponent);
  const WideInt mantissa(static_cast<Int128>(std::ldexp(m, 53)));
  const int power = 53 - exponent + Planes::kTimeBits;
  if (power >= 0) return {mantissa, WideInt(1) << power};
  return {mantissa << -power, WideInt(1)};
}

int Simulation::compareEvents(Event& a, Event& b) {
  if (a.time.value + a.time.error < b.time.value - b.time.error) return -1;
  if (a.time.value - a.time.error > b.time.value + b.time.error) return 1;
  exactOf(a);
  exactOf(b);
  const ExactTime &x = memo_[a.memo], &y = memo_[b.memo];
  return WideInt(x.num * y.den).compare(y.num * x.den);
}

bool Simulation::later(uint32_t a, uint32_t b) {
  const int order = compareEvents(events_[a], events_[b]);
  return order > 0 || (order == 0 && a > b);
}

void Simulation::push(Event e) {
  events_.push_back(e);
  heap_.push_back(static_cast<uint32_t>(events_.size() - 1));
  std::push_heap(heap_.begin(), heap_.end(),
                 [this](uint32_t a, uint32_t b) { return later(a, b); });
}

uint32_t Simulation::pop() {
  std::pop_heap(heap_.begin(), heap_.end(), [this](uint32_t a, uint32_t b) { return later(a, b); });
  const uint32_t id = heap_.back();
  heap_.pop_back();
  return id;
}

bool Simulation::isPast(const EventTime& t) {
  if (!started_) {
    if (t.value > t.error) return false;
    if (t.value < -t.error) return true;
    return planes_.exact(t).num.sign() <= 0;
  }
  Event e;
  e.time = t;
  if (t.value - t.error > now_.time.value + now_.time.error) return false;
  if (t.value + t.error < now_.time.value - now_.time.error) return true;
  const ExactTime x = planes_.exact(t);
  const ExactTime& y = exactOf(now_);
  return WideInt(x.num * y.den).compare(y.num * x.den) <= 0;
}

// Parts of the wavefront.

uint32_t Simulation::newEdge(PlaneId plane, uint32_t face) {
  const auto id = static_cast<uint32_t>(edges_.size());
  WaveEdge e;
  e.plane = plane;
  e.face = face;
  edges_.push_back(e);
  if (fragments_[plane].empty()) livePlanes_.push_back(plane);
  fragments_[plane].push_back(id);
  ++aliveEdges_;
  return id;
}

uint32_t Simulation::newVertex(uint32_t left, uint32_t right, uint32_t node) {
  const auto id = static_cast<uint32_t>(vertices_.size());
  WaveVertex v;
  v.left = left;
  v.right = right;
  v.startNode = node;
  vertices_.push_back(v);
  edges_[left].head = id;
  edges_[right].tail = id;
  return id;
}

uint32_t Simulation::newNode(PlaneId p, PlaneId q, PlaneId r) {
  trace_.nodes.push_back({planes_.point(p, q, r)});
  return static_cast<uint32_t>(trace_.nodes.size() - 1);
}

void Simulation::endVertex(uint32_t v, uint32_t node) {
  WaveVertex& w = vertices_[v];
  if (w.alive && w.startNode != node) {
    trace_.arcs.push_back({w.startNode, node, edges_[w.left].face, edges_[w.right].face});
  }
  w.alive = false;
}

void Simulation::killEdge(uint32_t e) {
  if (!edges_[e].alive) return;
  edges_[e].alive = false;
  ++edges_[e].version;
  --aliveEdges_;
  auto& list = fragments_[edges_[e].plane];
  list.erase(std::find(list.begin(), list.end(), e));
  if (list.empty()) {
    livePlanes_.erase(std::find(livePlanes_.begin(), livePlanes_.end(), edges_[e].plane));
  }
}

void Simulation::addRing(const std::vector<WaveInput>& ring) {
  const size_t first = edges_.size();
  for (size_t i = 0; i < ring.size(); ++i) {
    newEdge(ring[i].plane, static_cast<uint32_t>(first + i));
  }
  for (size_t i = 0; i < ring.size(); ++i) {
    const size_t before = (i + ring.size() - 1) % ring.size();
    newVertex(static_cast<uint32_t>(first + before), static_cast<uint32_t>(first + i),
              ring[i].startNode);
  }
}

// What happens at an event.

// A chain of two edges encloses nothing; its two vertices are one path.
bool Simulation::finishPair(uint32_t v) {
  const uint32_t p = vertices_[v].left, q = vertices_[v].right;
  if (nextId(q) != p) return false;
  const uint32_t other = edges_[q].head;
  const uint32_t node = vertices_[v].startNode;
  vertices_[v].alive = false;
  endVertex(other, node);
  killEdge(p);
  killEdge(q);
  return true;
}

// Two neighbours of one plane go on as the left one.
void Simulation::mergeAcross(uint32_t v) {
  const uint32_t p = vertices_[v].left, q = vertices_[v].right;
  trace_.merges.push_back({edges_[p].face, edges_[q].face, vertices_[v].startNode});
  vertices_[v].alive = false;
  const uint32_t head = edges_[q].head;
  edges_[p].head = head;
  vertices_[head].left = p;
  killEdge(q);
}

// Removes an edge that has no length; its neighbours meet in a new vertex at the node.
void Simulation::collapse(uint32_t e, uint32_t node) {
  const uint32_t p = prevId(e), n = nextId(e);
  endVertex(edges_[e].tail, node);
  endVertex(edges_[e].head, node);
  killEdge(e);
  if (p == n) {
    killEdge(p);
    return;
  }
  settle(newVertex(p, n, node));
}

// The neighbours of v coincide in one line. The vertex runs along it to the nearer far end and the
// edge that ends there is gone. Of two edges with one direction the faster one takes the line.
void Simulation::runAlong(uint32_t v) {
  const uint32_t p = vertices_[v].left, q = vertices_[v].right;
  const PlaneId P = planeOf(p), Q = planeOf(q);
  const PlaneId X = planeOf(prevId(p)), D = planeOf(nextId(q));
  bool takeQ = true;
  if (planes_.sameDirection(P, Q)) {
    takeQ = planes_.compareSpeed(P, Q) >= 0;
  } else if (X != D) {
    // How far beyond the end of q lies the start of p? The plane after q tells.
    const int beyond = -planes_.side(P, Q, X, D) * planes_.turn(Q, D);
    takeQ = beyond >= 0;
  }
  const PlaneId third = takeQ ? D : X;
  if (planes_.turn(P, third) == 0) {
    // The far end is such a vertex itself and has not left its node yet.
    const uint32_t far = takeQ ? edges_[q].head : edges_[p].tail;
    collapse(takeQ ? q : p, vertices_[far].startNode);
    return;
  }
  collapse(takeQ ? q : p, newNode(P, Q, third));
}

// Brings a new vertex into order with its neighbours, then schedules what it will do.
void Simulation::settle(uint32_t v) {
  if (!vertices_[v].alive || stuck_) return;
  const uint32_t p = vertices_[v].left, q = vertices_[v].right;
  const uint32_t node = vertices_[v].startNode;
  if (p == q) {
    vertices_[v].alive = false;
    killEdge(p);
    return;
  }
  if (finishPair(v)) return;
  const PlaneId P = planeOf(p), Q = planeOf(q);
  if (P == Q) {
    mergeAcross(v);
    if (nextId(p) == p || nextId(nextId(p)) == p)
      settle(edges_[p].tail);
    else
      scheduleCollapse(p);
    return;
  }
  if (planeOf(nextId(q)) == P) {
    collapse(q, node);
    return;
  }
  if (planeOf(prevId(p)) == Q) {
    collapse(p, node);
    return;
  }
  if (planes_.turn(P, Q) == 0) {
    runAlong(v);
    return;
  }
  schedule(v);
}

void Simulation::split(uint32_t v, uint32_t e) {
  const uint32_t p = vertices_[v].left, q = vertices_[v].right;
  const uint32_t node = newNode(planeOf(p), planeOf(q), planeOf(e));
  endVertex(v, node);
  // e keeps its part before the node; the part after it is a new edge.
  const uint32_t rest = newEdge(planeOf(e), edges_[e].face);
  const uint32_t head = edges_[e].head;
  edges_[rest].head = head;
  vertices_[head].left = rest;
  const uint32_t a = newVertex(p, rest, node);
  const uint32_t b = newVertex(e, q, node);
  settle(a);
  settle(b);
}

// The edge of a plane that v is on at the time of their meeting, or kNone.
uint32_t Simulation::struckEdge(uint32_t v, PlaneId plane) const {
  const uint32_t p = vertices_[v].left, q = vertices_[v].right;
  const PlaneId P = planeOf(p), Q = planeOf(q);
  for (const uint32_t e : fragments_[plane]) {
    work();
    if (e == p || e == q || e == nextId(q) || e == prevId(p)) continue;
    const PlaneId before = planeOf(prevId(e)), after = planeOf(nextId(e));
    if (planes_.side(P, Q, plane, after) * planes_.turn(plane, after) < 0) continue;
    if (planes_.side(P, Q, plane, before) * planes_.turn(before, plane) < 0) continue;
    return e;
  }
  return kNone;
}

// What is going to happen.

// An edge's length grows or shrinks evenly and is nothing when its planes meet. One that has been
// nothing and shrinks runs backwards: the wavefront crosses itself, as the polygon must have done.
void Simulation::scheduleCollapse(uint32_t e) {
  ++edges_[e].version;
  const PlaneId before = planeOf(prevId(e)), own = planeOf(e), after = planeOf(nextId(e));
  const auto t = planes_.meeting(before, own, after);
  if (!t) return;
  const bool past = isPast(*t);
  const int shrinks =
      planes_.speedSign(before, own, after) * planes_.turn(before, own) * planes_.turn(own, after);
  if (past ? shrinks > 0 : shrinks < 0) stuck_ = true;
  if (!past) push({*t, EventKind::Collapse, e, edges_[e].version, kNone});
}

/// Finds the planes that a reflex vertex may run into, after the mark `after` or from now on.
void Simulation::findCandidates(uint32_t v, const EventTime* after) {
  const PlaneId P = planeOf(vertices_[v].left), Q = planeOf(vertices_[v].right);
  const Plane &a = planes_[P], &b = planes_[Q];
  const double pq = a.na * b.nb - b.na * a.nb;
  // The determinants of (P, Q, E) are linear in E's plane.
  const double denA = a.nb * b.ns - b.nb * a.ns, denB = b.na * a.ns - a.na * b.ns;
  const double numA = a.nb * b.nc - b.nb * a.nc, numB = b.na * a.nc - a.na * b.nc;
  const double earliest = after != nullptr ? after->value
                          : started_       ? now_.time.value - now_.time.error
                                           : 0;
  candidates_.clear();
  for (const PlaneId E : livePlanes_) {
    work();
    if (E == P || E == Q) continue;
    const Plane& e = planes_[E];
    const double den = pq * e.ns + denA * e.na + denB * e.nb;
    const double num = pq * e.nc + numA * e.na + numB * e.nb;
    const double denError = kCandidateRounding * (a.ns + b.ns + e.ns);
    // The plane is ahead of the vertex only while det(a b s) is negative.
    if (den > denError) continue;
    const double numError = kCandidateRounding * (std::abs(a.nc) + std::abs(b.nc) + std::abs(e.nc));
    Candidate c{0, false, {num / den, 0, {P, Q, E}}};
    if (den < -4 * denError) {
      c.time.error =
          1.01 * (numError + std::abs(c.time.value) * denError) / (std::abs(den) - denError);
      c.low = c.time.value - c.time.error;
      if (c.time.value + c.time.error < earliest) continue;
    } else if (std::abs(num) - numError > 5 * denError * kLate) {
      // The vertex runs along with the plane.
      c.low = kLate;
    } else if (!evaluate(c)) {
      continue;
    }
    c.late = c.low >= kLate;
    if (!c.late && ((after != nullptr && c.low <= after->value) || isPast(c.time))) continue;
    candidates_.push_back(c);
  }
}

/// Puts the exact time into a candidate; false where there is no meeting ahead.
bool Simulation::evaluate(Candidate& c) const {
  const auto [P, Q, E] = c.time.planes;
  if (planes_.speedSign(P, Q, E) >= 0) return false;
  const auto t = planes_.meeting(P, Q, E);
  if (!t) return false;
  c.time = *t;
  c.low = t->value - t->error;
  c.late = false;
  return true;
}

/// Pushes the earliest candidates of a reflex vertex, and a mark to look for more when they are
/// used up. `after` is the mark that was reached.
void Simulation::scheduleSplits(uint32_t v, const EventTime* after) {
  findCandidates(v, after);
  const auto lateOnes = std::stable_partition(candidates_.begin(), candidates_.end(),
                                              [](const Candidate& c) { return !c.late; });
  size_t known = static_cast<size_t>(lateOnes - candidates_.begin());
  const bool lookedAtLate = known == 0 && after != nullptr;
  if (lookedAtLate) {
    // Nothing but late ones is left: now they are looked at, all at once.
    std::erase_if(candidates_, [this](Candidate& c) { return !evaluate(c) || isPast(c.time); });
    known = candidates_.size();
  }
  uint32_t& batch = vertices_[v].batch;
  size_t take = lookedAtLate ? known : std::min<size_t>(known, batch);
  if (take < candidates_.size()) {
    Event mark;
    mark.kind = EventKind::MoreCandidates;
    mark.subject = v;
    if (take > 0) {
      std::nth_element(candidates_.begin(),
                       candidates_.begin() + static_cast<std::ptrdiff_t>(take - 1),
                       candidates_.begin() + static_cast<std::ptrdiff_t>(known),
                       [](const Candidate& x, const Candidate& y) { return x.low < y.low; });
      mark.time.value = candidates_[take - 1].low;
    } else {
      mark.time.value = kLate / 2;
    }
    // Lows below nothing only repeat candidates, and their exact form needs few digits.
    if (std::abs(mark.time.value) < 0x1p-40) mark.time.value = -0x1p-40;
    // Equal lows belong to the batch, since the next one starts strictly after the mark.
    for (size_t i = take; i < known; ++i) {
      work();
      if (candidates_[i].low <= mark.time.value) std::swap(candidates_[i], candidates_[take++]);
    }
    batch *= 2;
    push(mark);
  }
  for (size_t i = 0; i < take; ++i) {
    push({candidates_[i].time, EventKind::Split, v, candidates_[i].time.planes[2], kNone});
  }
}

void Simulation::schedule(uint32_t v) {
  const uint32_t p = vertices_[v].left, q = vertices_[v].right;
  scheduleCollapse(p);
  scheduleCollapse(q);
  if (planes_.turn(planeOf(p), planeOf(q)) < 0) scheduleSplits(v, nullptr);
}

// Ends every path at the top level.
void Simulation::capAll() {
  std::vector<uint32_t> capNode(vertices_.size(), kNone);
  for (uint32_t v = 0; v < capNode.size(); ++v) {
    if (!vertices_[v].alive) continue;
    capNode[v] = newNode(planeOf(vertices_[v].left), planeOf(vertices_[v].right), top_);
    endVertex(v, capNode[v]);
  }
  for (const WaveEdge& e : edges_) {
    if (e.alive) trace_.tops.push_back({capNode[e.tail], capNode[e.head], e.face});
  }
}

WaveEnd Simulation::run() {
  const size_t corners = vertices_.size();
  // Equal and parallel neighbours first, while every corner still stands where it was put in.
  for (uint32_t v = 0; v < corners; ++v) {
    work();
    if (!vertices_[v].alive) continue;
    const PlaneId P = planeOf(vertices_[v].left), Q = planeOf(vertices_[v].right);
    if (P == Q && nextId(vertices_[v].right) != vertices_[v].left) mergeAcross(v);
  }
  for (uint32_t v = 0; v < corners && !stuck_; ++v) {
    if (!vertices_[v].alive) continue;
    if (planes_.turn(planeOf(vertices_[v].left), planeOf(vertices_[v].right)) == 0) runAlong(v);
  }
  for (uint32_t v = 0; v < vertices_.size() && !stuck_; ++v) {
    if (!vertices_[v].alive) continue;
    scheduleCollapse(vertices_[v].right);
    if (v < corners && planes_.turn(planeOf(vertices_[v].left), planeOf(vertices_[v].right)) < 0) {
      scheduleSplits(v, nullptr);
    }
  }
  Event level;
  if (top_ != kNone) {
    level.kind = EventKind::MoreCandidates;
    level.time.value = planes_[top_].nc;
  }
  // Of events that change something there are a few per corner, of others at most one for each
  // pair of a corner and a plane; this is beyond any run that goes right.
  const size_t limit = 4096 + 64 * corners + corners * corners * 4;
  while (!stuck_ && aliveEdges_ > 0 && !heap_.empty()) {
    work(16);
    if (++steps_ > limit) return WaveEnd::Stuck;
    const uint32_t id = pop();
    if (top_ != kNone && compareEvents(events_[id], level) > 0) break;
    const Event event = events_[id];
    if (event.kind == EventKind::Collapse) {
      const WaveEdge& e = edges_[event.subject];
      if (!e.alive || e.version != event.detail) continue;
      now_ = event;
      started_ = true;
      const auto& t = event.time.planes;
      collapse(event.subject, newNode(t[0], t[1], t[2]));
      continue;
    }
    if (!vertices_[event.subject].alive) continue;
    if (event.kind == EventKind::MoreCandidates) {
      scheduleSplits(event.subject, &event.time);
      continue;
    }
    const uint32_t struck = struckEdge(event.subject, event.detail);
    if (struck == kNone) continue;
    now_ = event;
    started_ = true;
    split(event.subject, struck);
  }
  if (stuck_) return WaveEnd::Stuck;
  if (aliveEdges_ == 0) return now_.time.value > kNever ? WaveEnd::Unbounded : WaveEnd::Done;
  if (top_ == kNone) return WaveEnd::Stuck;
  capAll();
  return WaveEnd::Done;
}

}  // namespace

WaveEnd runWavefront(const Planes& planes, const std::vector<std::vector<WaveInput>>& rings,
                     uint32_t top, Trace& trace) {
  Simulation simulation(planes, top, trace);
  for (const auto& ring : rings) simulation.addRing(ring);
  return simulation.run();
}

}  // namespace gable::skeleton
