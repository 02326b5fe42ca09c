// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Who makes which items. A seed is derived once for all its cameras, so a seed is what is locked;
// threads that have no seed left help with the pictures of the last ones.
// All that is made is a function of the settings, so it does not matter by whom, nor in what order.

#include "engine/dataset.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <set>
#include <utility>

#include "base/file_lock.h"
#include "base/parallel.h"
#include "engine/guard.h"
#include "engine/shared_pictures.h"
#include "gable/files.h"

namespace gable {

namespace {

std::optional<Error> mistakeIn(const DatasetSettings& s) {
  const auto wrong = [](const char* what, const char* remedy) {
    return Error{"dataset-settings", what, remedy};
  };
  constexpr uint64_t kMostSeeds = 1'000'000;
  if (s.count < 1 || s.count > kMostSeeds) {
    return wrong("a data set has 1 to 1000000 seeds", "correct the count");
  }
  if (s.cameras < 1 || s.cameras > 100'000) {
    return wrong("a seed has 1 to 100000 cameras", "correct their number");
  }
  if (!(s.zoom >= 0.1 && s.zoom <= 100)) {
    return wrong("a lens brings things a tenth to a hundred times nearer", "correct the zoom");
  }
  if (s.shard && (s.shard->of < 1 || s.shard->index >= s.shard->of)) {
    return wrong("a shard is one of as many as there are", "the first of four is 0 of 4");
  }
  if (!s.tags.empty() && s.labels != DatasetLabels::Tag) {
    return wrong("tags are named, but labels do not go by them", "label by tag");
  }
  const std::set<std::string> tags(s.tags.begin(), s.tags.end());
  if (tags.size() != s.tags.size() || tags.contains("")) {
    return wrong("a tag is named twice, or has no name", "name each tag once");
  }
  const std::vector<std::string>& known = modelExtensions();
  if (!s.model.empty() && std::find(known.begin(), known.end(), s.model) == known.end()) {
    return wrong("the mesh's format is not known", "name an extension that models have, as glb");
  }
  return std::nullopt;
}

bool wasCancelled(const DiagnosticList& diagnostics) {
  return std::any_of(diagnostics.begin(), diagnostics.end(),
                     [](const Diagnostic& d) { return d.code == "was-cancelled"; });
}

class Maker {
 public:
  Maker(const Rules& rules, const Shapes& shapes, const DatasetSettings& settings,
        const DatasetFolder& folder, const Categories& categories, Task& task,
        DatasetResult& result)
      : rules_(rules),
        shapes_(shapes),
        settings_(settings),
        folder_(folder),
        categories_(categories),
        task_(task),
        result_(result),
        jobs_(settings.jobs.value_or(0) > 0 ? static_cast<uint64_t>(*settings.jobs)
                                            : defaultJobs()) {}

  void run() {
    std::vector<uint64_t> seeds;
    for (uint64_t seed = 0; seed < settings_.count; ++seed) {
      result_.done += folder_.itemsOf(seed);
      const auto& shard = settings_.shard;
      if (shard && seed % shard->of != shard->index) continue;
      if (!folder_.isWhole(seed)) seeds.push_back(seed);
    }
    tell(0);
    due_ = seeds.size() * settings_.cameras;
    const size_t workers = std::max<size_t>(1, std::min<size_t>(jobs_, due_));
    std::atomic<size_t> next{0};
    parallelFor(workers, static_cast<unsigned>(workers), [&](size_t, unsigned) {
      for (;;) {
        const SharedPictures::Coming coming(shared_);
        const size_t i = next++;
        if (i >= seeds.size()) break;
        if (!stopped_) makeSeed(seeds[i]);
      }
      shared_.help();
    });
  }

 private:
  /// Processors for one of so many things that are made side by side.
  int threadsFor(uint64_t things) const {
    return static_cast<int>(jobs_ / std::clamp<uint64_t>(things, 1, jobs_));
  }

  void makeSeed(uint64_t seed) {
    const std::string path = folder_.lock(seed);
    const FileLock lock(path);
    if (!lock.held() && (lock.failure().empty() || folder_.isWhole(seed))) return;
    if (!lock.held() && !settings_.shard) {
      return stop({diagnosticOf(
          Error{"dataset-lock", "'" + path + "' cannot be locked: " + lock.failure(),
                "where the file system has no locks, give each process a shard of its own"})});
    }
    // It may have been made since it was looked at.
    if (!folder_.isWhole(seed)) fill(seed);
    // Nobody needs the lock of what is whole, and where there is a mistake it is everybody's.
    if (stopped_ || folder_.isWhole(seed)) lock.finish();
  }

  void fill(uint64_t seed) {
    const double number = settings_.derive.seed + static_cast<double>(seed);
    DeriveSettings derive = settings_.derive;
    derive.seed = number;
    derive.jobs = threadsFor(1 + (due_ - ended_ - 1) / settings_.cameras);
    derive.trace = settings_.labels != DatasetLabels::Rule;
    derive.progress = nullptr;
    const Model model = gable::derive(rules_, shapes_, derive);
    note(model.diagnostics());
    if (model.end() != End::Done) return stop({}, model.end());
    if (hasErrors(model.diagnostics())) return stop({});
    const PictureMaker maker(model, settings_.limits);
    if (!maker.ok()) return stopAt(maker.diagnostics());
    // Settings that no picture can be made by must not become those of the folder.
    if (!maker.pose(settings_.picture)) return stop(maker.draw(settings_.picture).diagnostics);
    if (const auto e = folder_.begin()) return stop({diagnosticOf(*e)});
    if (!settings_.model.empty() && !folder_.has(folder_.model(seed))) {
      WriteSettings write = settings_.write;
      if (!write.limits.cancel) write.limits.cancel = settings_.limits.cancel;
      if (!put(folder_.model(seed), [&](const std::string& aside) {
            return model.write(aside + "model." + settings_.model, write).diagnostics;
          })) {
        return;
      }
    }
    const Labeller labeller(rules_, categories_, settings_.labels, model);
    shared_.drawAll(settings_.cameras, [&](uint32_t camera) {
      draw({folder_.item(seed, camera), seed * settings_.cameras + camera + 1, number, camera},
           maker, labeller);
      ++ended_;
    });
  }

  void draw(const DatasetItem& item, const PictureMaker& maker, const Labeller& labeller) {
    if (stopped_ || folder_.has(item.name)) return;
    if (!task_.allowance().look(0, 0)) return stopByLimit();
    PictureSettings settings = pictureOf(maker, settings_, item.seed, item.camera);
    settings.jobs = threadsFor(due_ - ended_);
    settings.progress = nullptr;
    settings.limits = settings_.limits;
    // Half a picture is none.
    if (settings.cancel) settings.limits.cancel = std::exchange(settings.cancel, nullptr);
    const PictureData picture = maker.draw(settings);
    if (!picture.ok) {
      const bool limited = !hasErrors(picture.diagnostics) || wasCancelled(picture.diagnostics);
      return limited ? stopByLimit() : stop(picture.diagnostics);
    }
    note(picture.diagnostics);
    const bool made = put(item.name, [&](const std::string& aside) {
      return writeItem(item, picture, labeller.marks(picture.layers), aside);
    });
    if (made) tell(1);
  }

  bool put(const std::string& part,
           const std::function<DiagnosticList(const std::string& aside)>& fill) {
    const DiagnosticList wrong = folder_.put(part, fill);
    if (wrong.empty()) return true;
    // What is half written when it is cancelled is made again by the next run.
    stopAt(wrong);
    return false;
  }

  void tell(uint64_t made) {
    const std::lock_guard lock(telling_);
    result_.made += made;
    result_.done += made;
    if (settings_.progress) settings_.progress(result_.done, result_.items);
  }

  // What seeds have in common is told once.
  void note(const DiagnosticList& diagnostics) {
    const std::lock_guard lock(telling_);
    for (const Diagnostic& d : diagnostics) {
      if (told_.insert(d.code + d.message).second) result_.diagnostics.push_back(d);
    }
  }

  void stop(const DiagnosticList& why, End end = End::Done) {
    stopped_ = true;
    note(why);
    const std::lock_guard lock(telling_);
    if (end != End::Done) result_.end = end;
  }

  /// What is no mistake where the user has stopped it.
  void stopAt(const DiagnosticList& wrong) {
    if (wasCancelled(wrong))
      stopByLimit();
    else
      stop(wrong);
  }

  void stopByLimit() {
    const std::atomic<bool>* const cancel = settings_.picture.cancel;
    stop({task_.warning()}, cancel && *cancel ? End::Cancelled : End::LimitReached);
  }

  const Rules& rules_;
  const Shapes& shapes_;
  const DatasetSettings& settings_;
  const DatasetFolder& folder_;
  const Categories& categories_;
  Task& task_;
  DatasetResult& result_;
  uint64_t jobs_;
  /// Pictures of all seeds that are to be made, and those of them that have been looked at.
  uint64_t due_ = 0;
  std::atomic<uint64_t> ended_{0};
  SharedPictures shared_;
  std::atomic<bool> stopped_{false};
  std::mutex telling_;
  std::set<std::string> told_;
};

DatasetResult made(const Rules& rules, const Shapes& shapes, const std::string& path,
                   const DatasetSettings& settings, Task& task) {
  if (!rules.ok()) return {};
  if (const auto e = mistakeIn(settings)) return failed<DatasetResult>(*e);
  const Result<Categories> categories = categoriesOf(rules, settings);
  if (!categories.ok()) return failed<DatasetResult>(categories.error());
  DatasetFolder folder(path, settings);
  if (const auto e = folder.open(descriptionOf(rules, shapes, categories.value(), settings))) {
    folder.close();
    return failed<DatasetResult>(*e);
  }
  DatasetResult result;
  result.items = settings.count * settings.cameras;
  Maker(rules, shapes, settings, folder, categories.value(), task, result).run();
  folder.close();
  if (hasErrors(result.diagnostics) || result.end != End::Done) return result;
  result.ok = true;
  for (uint64_t seed = 0; seed < settings.count; ++seed) {
    if (!folder.isWhole(seed)) return result;
  }
  result.done = result.items;
  const DiagnosticList wrong = writeList(folder, settings, categories.value());
  result.merged = result.ok = wrong.empty();
  result.diagnostics.insert(result.diagnostics.end(), wrong.begin(), wrong.end());
  return result;
}

}  // namespace

DatasetResult writeDataset(const Rules& rules, const Shapes& shapes, const std::string& folder,
                           const DatasetSettings& settings) {
  return guardedResult<DatasetResult>(Task("writing", folder, settings.limits), [&](Task& task) {
    return made(rules, shapes, folder, settings, task);
  });
}

}  // namespace gable
