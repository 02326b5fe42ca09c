// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Session: derivations for pages. Rules, shapes and the latest models stay in memory, so that a
// keystroke costs what it changes. A derivation that a page asks for cancels the one before of the
// same page and lane; all are limited.
//
// Any thread may call. What is asked for and answered: docs/dev/studio-protocol.md.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/json.h"
#include "gable/gable.h"
#include "studio/project_files.h"

namespace gable::studio {

class Session {
 public:
  using Cancel = std::shared_ptr<std::atomic<bool>>;

  /// Derivations are numbered from the one after `before`.
  explicit Session(const ProjectFiles& files, const SearchSettings& search = {},
                   uint64_t before = 0)
      : files_(files), search_(search), last_(before) {}

  /// A request for derive() or tree() has come, which may have to wait: the one before of the same
  /// page ends now.
  void announce(const JsonValue& request, const Cancel& cancel);
  /// The answer to /api/derive: "GBS1", JSON; then the draw list in pieces.
  struct Answer {
    std::string head;
    std::vector<std::string> list;
  };
  Result<Answer> derive(const JsonValue& request, const Cancel& cancel);
  /// The pieces of an answer that has been sent: the next one has their memory.
  void reuse(std::vector<std::string> pieces);
  /// Readies memory for the next derivation of a page, when its answer is on its way. Large models
  /// have none.
  void prepareNext(const std::string& page) const;
  /// The answer to /api/tree: "GBT1", JSON, nodes; with "steps" the draw list of all steps' shapes.
  Result<std::string> tree(const JsonValue& request, const Cancel& cancel);
  /// JSON of a leaf by its number in the draw list.
  Result<std::string> leaf(uint64_t derivation, uint64_t number) const;
  /// JSON of what lies directly below a part of a derivation (Model::parts).
  Result<std::string> parts(uint64_t derivation, uint64_t leaf, uint64_t level) const;
  /// A derivation that is kept. Code: derivation-gone.
  Result<Model> model(uint64_t derivation) const;
  /// Keeps a model that was not derived, for its textures; its number.
  uint64_t adopt(Model model);
  /// Shapes of a request: a lot, a polygon, a file or some shapes of it.
  Result<std::shared_ptr<const Shapes>> shapesOf(const JsonValue& request);
  Result<std::string> texture(uint64_t derivation, const std::string& path) const;
  /// Initial shapes done and in all, of the derivation that a page waits for.
  std::pair<size_t, size_t> progress(const std::string& page) const;
  /// Files have changed: what was read of them is read again.
  void forget();

 private:
  struct Work;
  enum class Trace : uint8_t { None, Tree, Steps };
  struct Made {
    uint64_t number;
    Model model;
    /// Models of other pages, or of a page's wall of variations, do not push this one out.
    std::string page;
    uint64_t leaves = 0;
    /// What the page holds of it, where it was sent in chunks.
    std::shared_ptr<const DrawnChunks> drawn;
  };
  /// With the lock held.
  void keepModel(Made made);

  std::shared_ptr<const Rules> rulesOf(const JsonValue& request);
  Result<std::shared_ptr<const Shapes>> fileShapes(const std::string& file);
  std::optional<Model> made(uint64_t number) const;
  /// What a page holds that says which derivation it shows; null where that is not known.
  std::shared_ptr<const DrawnChunks> drawnOf(const JsonValue& known) const;
  void keepDrawn(uint64_t number, std::shared_ptr<const DrawnChunks> drawn);
  /// The model that was derived last for a page.
  std::optional<Model> lastOf(const std::string& page) const;
  std::vector<std::string> takeRoom();
  std::shared_ptr<Work> begin(const JsonValue& request, const Cancel& cancel);
  Result<Model> deriveFor(const JsonValue& request, const Rules& rules, Work& work, Trace trace);

  const ProjectFiles& files_;
  const SearchSettings search_;
  mutable std::mutex mutex_;
  std::deque<std::pair<std::string, std::shared_ptr<const Rules>>> rules_;
  std::deque<std::pair<std::string, std::shared_ptr<const Shapes>>> shapes_;
  std::deque<Made> made_;
  std::map<std::string, std::shared_ptr<Work>> works_;
  uint64_t last_;
  std::vector<std::string> room_;
};

}  // namespace gable::studio
