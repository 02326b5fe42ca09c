// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable-maps osm|pbf: reads an OpenStreetMap file from standard input and writes it as GeoJSON to
// standard output. gable calls it: libosmium trusts its input in part, so it runs in a process of
// its own, which limits its memory and time and opens no file.
//
// A feature each for what has tags: areas (closed ways that mean one, multipolygons) as
// MultiPolygon, other ways as LineString, nodes as Point, in the order of the file, areas of
// relations last. Properties are the tags; `id` is "way/123", "relation/5" or "node/7". Coordinates
// have the seven digits of the map: ends of lines that share a node are equal. What cannot be
// assembled (a broken ring, a node or a way that the file lacks) is counted in `passedOver`; the
// first of it stands in `leftOut`, pairs of an id and a reason.

#include <osmium/area/assembler.hpp>
#include <osmium/area/multipolygon_manager.hpp>
#include <osmium/handler/node_locations_for_ways.hpp>
#include <osmium/index/map/flex_mem.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/visitor.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../limit_self.h"

namespace {

constexpr OwnLimits kLimits{rlim_t{8} << 30, 300};

using Index = osmium::index::map::FlexMem<osmium::unsigned_object_id_type, osmium::Location>;
// Of the map's own nodes, and of those that an editor has just drawn, with negative numbers.
using Locations = osmium::handler::NodeLocationsForWays<Index, Index>;
using Assembler = osmium::area::Assembler;
using Multipolygons = osmium::area::MultipolygonManager<Assembler>;

// Whether a closed way means the area that it encloses. Most keys do; these are lines where no
// tag says otherwise (https://wiki.openstreetmap.org/wiki/Key:area).
bool meansArea(const osmium::TagList& tags) {
  if (const char* area = tags["area"]) return std::strcmp(area, "no") != 0;
  constexpr std::array<std::string_view, 5> kAreas{"building", "building:part", "landuse",
                                                   "leisure", "amenity"};
  constexpr std::array<std::string_view, 7> kLines{"highway", "barrier",   "railway", "waterway",
                                                   "power",   "aerialway", "boundary"};
  const auto has = [&](const auto& keys) {
    return std::any_of(keys.begin(), keys.end(),
                       [&](std::string_view key) { return tags.has_key(key.data()); });
  };
  const char* natural = tags["natural"];
  const bool lineOfNature =
      natural && (std::strcmp(natural, "coastline") == 0 || std::strcmp(natural, "cliff") == 0 ||
                  std::strcmp(natural, "tree_row") == 0);
  return has(kAreas) || !(has(kLines) || lineOfNature);
}

// What has no tags is a part of something else.
bool isTagged(const osmium::OSMObject& o) { return !o.tags().empty(); }

/// What could not be assembled, the first of it by name.
struct PassedOver {
  static constexpr size_t kNamed = 1000;
  uint64_t count = 0;
  std::vector<std::pair<std::string, const char*>> first;

  void add(const char* kind, osmium::object_id_type id, const char* reason) {
    ++count;
    if (first.size() < kNamed) first.emplace_back(kind + ('/' + std::to_string(id)), reason);
  }
};

/// GeoJSON, piece by piece to standard output.
class Writer {
 public:
  Writer() { out_ = R"({"type":"FeatureCollection","features":[)"; }

  void begin(const char* kind, osmium::object_id_type id, const osmium::TagList& tags,
             const char* geometry) {
    out_ += first_ ? "\n" : ",\n";
    first_ = false;
    out_ += R"({"type":"Feature","id":")";
    out_ += kind;
    out_ += '/' + std::to_string(id) + R"(","properties":{)";
    bool more = false;
    for (const osmium::Tag& t : tags) {
      if (more) out_ += ',';
      more = true;
      quote(t.key());
      out_ += ':';
      quote(t.value());
    }
    out_ += R"(},"geometry":{"type":")";
    out_ += geometry;
    out_ += R"(","coordinates":)";
  }
  void end() {
    out_ += "}}";
    if (out_.size() > kFull) flush();
  }
  void open() {
    separate();
    out_ += '[';
  }
  void close() { out_ += ']'; }
  void point(const osmium::Location& at) {
    separate();
    out_ += '[';
    degrees(at.x());
    out_ += ',';
    degrees(at.y());
    out_ += ']';
  }
  void finish(const PassedOver& passedOver) {
    out_ += "\n],\"passedOver\":" + std::to_string(passedOver.count) + ",\"leftOut\":[";
    for (const auto& [id, reason] : passedOver.first) {
      separate();
      out_ += "[\"" + id + "\",\"" + reason + "\"]";
    }
    out_ += "]}\n";
    flush();
    std::cout.flush();
  }

 private:
  static constexpr size_t kFull = size_t{1} << 20;

  void separate() {
    if (out_.back() == ']') out_ += ',';
  }
  // A coordinate is an integer of 1e-7 degrees.
  void degrees(int32_t v) {
    char text[16];
    const uint32_t u = v < 0 ? 0u - static_cast<uint32_t>(v) : static_cast<uint32_t>(v);
    std::snprintf(text, sizeof text, "%s%u.%07u", v < 0 ? "-" : "", u / 10000000, u % 10000000);
    out_ += text;
  }
  void quote(const char* text) {
    out_ += '"';
    for (; *text; ++text) {
      const auto c = static_cast<unsigned char>(*text);
      if (c == '"' || c == '\\') {
        out_ += '\\';
        out_ += *text;
      } else if (c < 0x20) {
        char code[8];
        std::snprintf(code, sizeof code, "\\u%04x", c);
        out_ += code;
      } else {
        out_ += *text;
      }
    }
    out_ += '"';
  }
  void flush() {
    std::cout.write(out_.data(), static_cast<std::streamsize>(out_.size()));
    out_.clear();
  }

  std::string out_;
  bool first_ = true;
};

class Features : public osmium::handler::Handler {
 public:
  explicit Features(Writer& out) : out_(out) {}

  void node(const osmium::Node& n) {
    if (!isTagged(n) || !n.location().valid()) return;
    out_.begin("node", n.id(), n.tags(), "Point");
    out_.point(n.location());
    out_.end();
  }

  void way(const osmium::Way& w) {
    if (!isTagged(w) || (w.is_closed() && w.nodes().size() > 3 && meansArea(w.tags()))) return;
    const bool whole = std::all_of(w.nodes().begin(), w.nodes().end(),
                                   [](const osmium::NodeRef& n) { return n.location().valid(); });
    if (!whole || w.nodes().size() < 2) {
      passedOver.add("way", w.id(), whole ? "it has fewer than two nodes" : kLacksNodes);
      return;
    }
    out_.begin("way", w.id(), w.tags(), "LineString");
    ring(w.nodes());
    out_.end();
  }

  void area(const osmium::Area& a) {
    if (!isTagged(a) || (a.from_way() && !meansArea(a.tags()))) return;
    const auto [outer, inner] = a.num_rings();
    if (outer == 0) {
      passedOver.add(a.from_way() ? "way" : "relation", a.orig_id(),
                     "its ways make no ring that is closed");
      return;
    }
    out_.begin(a.from_way() ? "way" : "relation", a.orig_id(), a.tags(), "MultiPolygon");
    out_.open();
    for (const osmium::OuterRing& o : a.outer_rings()) {
      out_.open();
      ring(o);
      for (const osmium::InnerRing& i : a.inner_rings(o)) ring(i);
      out_.close();
    }
    out_.close();
    out_.end();
  }

  PassedOver passedOver;

 private:
  static constexpr const char* kLacksNodes = "the file lacks some of its nodes";
  void ring(const osmium::NodeRefList& nodes) {
    out_.open();
    for (const osmium::NodeRef& n : nodes) out_.point(n.location());
    out_.close();
  }

  Writer& out_;
};

void convert(const osmium::io::File& file) {
  osmium::area::AssemblerConfig config;
  Multipolygons multipolygons{config};
  osmium::relations::read_relations(file, multipolygons);

  Index index, drawn;
  Locations locations{index, drawn};
  // Ways at the edge of an extract name nodes that it lacks.
  locations.ignore_errors();
  Writer writer;
  Features features{writer};
  osmium::io::Reader reader{file};
  osmium::apply(reader, locations, features,
                multipolygons.handler(
                    [&](const osmium::memory::Buffer& areas) { osmium::apply(areas, features); }));
  reader.close();
  multipolygons.for_each_incomplete_relation([&](const osmium::relations::RelationHandle& handle) {
    const char* type = handle->tags()["type"];
    // Those of a boundary are longer than any extract.
    if (type && std::strcmp(type, "multipolygon") == 0) {
      features.passedOver.add("relation", handle->id(), "the file lacks some of its ways");
    }
  });
  writer.finish(features.passedOver);
}

int fail(const std::string& why) {
  std::string line = why;
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::cout << line;
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string format = argc == 2 ? argv[1] : "";
  if (format != "osm" && format != "pbf") return fail("usage: gable-maps osm|pbf");
  limitSelf(kLimits);
  try {
    std::ios::sync_with_stdio(false);
    const std::string bytes{std::istreambuf_iterator<char>(std::cin), {}};
    convert(osmium::io::File{bytes.data(), bytes.size(), format});
    return std::cout ? 0 : 1;
  } catch (const std::exception& e) {
    return fail(e.what());
  }
}
