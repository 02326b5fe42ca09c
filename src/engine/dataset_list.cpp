// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The list of all items, put together from their item.json one after the other.

#include "base/files.h"
#include "base/json_copy.h"
#include "engine/dataset.h"
#include "gable/files.h"

namespace gable {

namespace {

class List {
 public:
  List(const DatasetFolder& folder, const DatasetSettings& settings, const Categories& categories,
       const TextSink& sink)
      : folder_(folder), settings_(settings), categories_(categories), sink_(sink) {}

  std::optional<Error> write() {
    const bool coco = settings_.format == DatasetFormat::Coco;
    sink_("{\"info\":{\"description\":\"A data set of Gable\"},\n\"categories\":[");
    writeCategories();
    sink_(coco ? "],\n\"images\":[" : "],\n\"items\":[");
    const auto about = [&](const JsonValue& item) { coco ? image(item) : camera(item); };
    if (auto e = forEachItem(headOf, about)) return e;
    if (coco) {
      sink_("],\n\"annotations\":[");
      const auto whole = [](const std::string& text) { return text; };
      if (auto e = forEachItem(whole, [&](const JsonValue& item) { annotations(item); })) return e;
    }
    sink_("]}\n");
    return std::nullopt;
  }

 private:
  // An item without its annotations, which are the last of its members and nearly all of its text.
  // What is cut off there is read when they are.
  static std::string headOf(const std::string& text) {
    const size_t end = text.find(",\"annotations\":");
    return end == std::string::npos ? text : text.substr(0, end) + "}";
  }

  /// Of each item, what `part` takes of its text.
  template <class Part, class Use>
  std::optional<Error> forEachItem(Part&& part, Use&& use) {
    first_ = true;
    for (uint64_t seed = 0; seed < settings_.count; ++seed) {
      for (uint32_t c = 0; c < settings_.cameras; ++c) {
        work();
        const std::string path = folder_.path() + folder_.item(seed, c) + "/item.json";
        const Result<std::string> text = readFile(path);
        if (!text.ok()) return text.error();
        const Result<JsonValue> json = parseJson(part(text.value()));
        if (!json.ok()) {
          return Error{"dataset-folder", "'" + path + "' is damaged: " + json.error().message,
                       "remove the folder of the item, and run again"};
        }
        use(json.value());
      }
    }
    return std::nullopt;
  }

  // An element of an array, a line each.
  template <class Fill>
  void element(Fill&& fill) {
    std::string text;
    JsonWriter w(text);
    w.beginObject();
    fill(w);
    w.endObject();
    sink_(first_ ? "\n" : ",\n");
    sink_(text);
    first_ = false;
  }

  void writeCategories() {
    for (size_t i = 0; i < categories_.size(); ++i) {
      element([&](JsonWriter& w) {
        w.field("id", static_cast<uint64_t>(i + 1)).field("name", categories_[i]);
        w.field("supercategory", "shape");
      });
    }
  }

  void image(const JsonValue& item) {
    element([&](JsonWriter& w) {
      copy(w.key("id"), item["id"]);
      w.field("file_name", item["name"].text() + "/image.png");
      for (const char* name : {"width", "height", "seed"}) copy(w.key(name), item[name]);
    });
  }

  void camera(const JsonValue& item) {
    element([&](JsonWriter& w) {
      for (const auto& [name, value] : item.members()) {
        if (name != "annotations") copy(w.key(name), value);
      }
      if (!settings_.model.empty()) {
        w.field("model", item["name"].text().substr(0, item["name"].text().find('/')) +
                             "/model/model." + settings_.model);
      }
    });
  }

  void annotations(const JsonValue& item) {
    for (const JsonValue& annotation : item["annotations"].items()) {
      element([&](JsonWriter& w) {
        w.field("id", ++annotations_);
        copy(w.key("image_id"), item["id"]);
        for (const auto& [name, value] : annotation.members()) copy(w.key(name), value);
      });
    }
  }

  const DatasetFolder& folder_;
  const DatasetSettings& settings_;
  const Categories& categories_;
  const TextSink& sink_;
  uint64_t annotations_ = 0;
  bool first_ = true;
};

}  // namespace

DiagnosticList writeList(const DatasetFolder& folder, const DatasetSettings& settings,
                         const Categories& categories) {
  const char* const name = settings.format == DatasetFormat::Coco ? "coco.json" : "items.json";
  std::optional<Error> wrong;
  FileWriter writer(folder.path() + name);
  const TextSink sink = [&](std::string_view text) { writer.append(text); };
  wrong = List(folder, settings, categories, sink).write();
  if (!wrong) {
    const Result<uint64_t> written = writer.finish();
    if (!written.ok()) wrong = written.error();
  }
  return wrong ? DiagnosticList{diagnosticOf(*wrong)} : DiagnosticList{};
}

}  // namespace gable
