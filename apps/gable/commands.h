// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The commands. Each takes its parsed arguments and gives an exit status.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common.h"

struct GenerateArguments {
  DeriveArguments derive;
  std::string output;
  std::string stats;
  ReportArguments reports;
  /// The part of --shapes: west,south,east,north.
  std::string box;
  WriteArguments write;
  /// Seeds, from that of --seed on, each with files of its own; 0: that of --seed alone.
  int count = 0;
  /// Run again whenever a file that is read changes, until Ctrl-C.
  bool watch = false;
  /// Warnings end it with status 1, as those of runCheck do; the model is written all the same.
  bool strict = false;
};
int runGenerate(const GenerateArguments& arguments);

/// Runs `once` with `count` seeds from the first on, written alike so that file names sort; ends
/// with the first that fails. With --json each has an answer of its own.
int forSeeds(int count, const std::string& firstSeed,
             const std::function<int(const std::string& seed)>& once);
/// "house-3.glb" of "house.glb"; empty and "-" stay.
std::string withSeed(const std::string& path, const std::string& seed);

struct CheckArguments {
  std::vector<std::string> rules;
  std::optional<std::string> project, dialect;
  gable::SearchSettings search;
  /// Print what the rules are compiled to as well.
  bool disassemble = false;
  /// Warnings end it as mistakes do.
  bool strict = false;
  LimitArguments limits;
};
int runCheck(const CheckArguments& arguments);

struct InfoArguments {
  DeriveArguments derive;
  /// List what imported files have as well. JSON has it always.
  bool all = false;
};
int runInfo(const InfoArguments& arguments);

struct NewArguments {
  /// Its last part is the name of the project.
  std::string folder;
};
int runNew(const NewArguments& arguments);

struct PackArguments {
  std::string rules;
  std::string output;
  std::optional<std::string> project, dialect;
  gable::SearchSettings search;
  LimitArguments limits;
};
int runPack(const PackArguments& arguments);

struct FormatArguments {
  std::vector<std::string> files;
  /// Say which files would change, and change none.
  bool check = false;
  /// Print to stdout instead of writing back.
  bool toStdout = false;
  LimitArguments limits;
};
int runFormat(const FormatArguments& arguments);

struct ConvertArguments {
  std::string rules;
  std::optional<std::string> project, dialect;
  gable::SearchSettings search;
  std::string output = "-";
  LimitArguments limits;
};
int runConvert(const ConvertArguments& arguments);

struct RenderArguments {
  DeriveArguments derive;
  std::string output;
  std::string view = "iso";
  std::string size = "1600x900";
  /// Absent: by the size.
  std::optional<int> samples;
  std::string sun;
  std::string eye, target;
  std::string ground;
  bool block = false;
  std::optional<double> fieldOfView, pitch;
  std::string look;
  /// Of gable::lightingNames().
  std::string lighting = "paths";
  /// latitude,longitude,date,hour
  std::string sunAt;
  std::optional<double> haze, clouds, mist, aperture, focus, lamps, litRooms;
  std::string exposure = "auto";
  std::string cut;
  std::optional<int> bounces;
  bool noDenoise = false;
  /// A folder for the layers; empty: none.
  std::string layers;
  /// Frames around the model, or along the path of a file; 0 and empty: one picture.
  int turntable = 0;
  std::string walk;
  /// Of a turntable.
  double framesPerSecond = 24;
  /// Seeds, from that of --seed on, each with files of its own; 0: that of --seed alone.
  int count = 0;
  /// Run again whenever a file that is read changes, until Ctrl-C.
  bool watch = false;
};
int runRender(const RenderArguments& arguments);
using PictureProgress = std::function<void(size_t done, size_t total)>;
/// Progress of one of several pictures, told as pixels of them all; empty where `shown` is.
PictureProgress pixelsOf(const PictureProgress& shown, const gable::PictureSettings& settings,
                         size_t frame = 0, size_t frames = 1);
/// Draws a model with a bar of progress.
int drawPicture(const gable::Model& model, const std::string& path,
                gable::PictureSettings settings);
/// An exit status other than kExitDone, with a message, when an option of the picture is wrong.
int pictureSettings(const RenderArguments& arguments, gable::PictureSettings& settings);
/// A turntable or a walk: numbered pictures, or a film of them.
int drawFrames(const gable::Model& model, const RenderArguments& arguments,
               const gable::PictureSettings& settings);
/// Whether a path names a model that can be read, by its extension.
bool isModel(const std::string& path);

/// gable watch: a picture or a model, by the ending of the output, made again at every change.
int runWatch(const RenderArguments& arguments);

struct DatasetArguments {
  /// The rules, and the options of the pictures; its output has no use.
  RenderArguments picture;
  std::string output;
  uint64_t count = 1;
  uint32_t cameras = 4;
  /// Of gable::datasetCamerasNames(), datasetLabelsNames(), datasetFormatNames().
  std::string placing = "orbit", labels = "rule", format = "coco";
  double zoom = 1;
  /// Of labels by tag.
  std::vector<std::string> tags;
  /// An extension of models, or "none".
  std::string model = "glb";
  WriteArguments write;
  /// "0/4"; empty: whatever nobody else is making.
  std::string shard;

  DatasetArguments() {
    picture.size = "512x512";
    picture.samples = 16;
  }
};
int runDataset(const DatasetArguments& arguments);

struct DiffArguments {
  std::string before, after;
  /// The options of the picture; its output may be empty.
  RenderArguments picture;
};
int runDiff(const DiffArguments& arguments);

struct TraceArguments {
  DeriveArguments derive;
  std::optional<std::string> rule;
  /// Names of rules with '/' between them.
  std::string path;
  std::optional<uint32_t> depth;
  std::string output = "-";
};
int runTrace(const TraceArguments& arguments);

struct AssetArguments {
  std::string model;
  std::string output;
  std::string pivot, rotate, volume;
  std::optional<std::string> name;
  bool zUp = false;
  LimitArguments limits;
};
int runAssetPrepare(const AssetArguments& arguments);

struct MaterialArguments {
  /// Without a name all are listed.
  std::string name;
  std::string folder;
};
int runAssetMaterial(const MaterialArguments& arguments);

struct OpsArguments {
  std::string name;
};
int runOps(const OpsArguments& arguments);

struct LspArguments {
  gable::SearchSettings search;
};
int runLsp(const LspArguments& arguments);
struct TestArguments {
  /// Test files, and folders with such files below them.
  std::vector<std::string> paths{"."};
  std::string filter;
  /// "text", "tap" or "junit".
  std::string format = "text";
  std::string output = "-";
  std::optional<std::string> project;
  gable::SearchSettings search;
  std::optional<int> jobs;
  bool update = false;
  /// Run again whenever a file of the folders changes, until Ctrl-C.
  bool watch = false;
  LimitArguments limits;
};
int runTest(const TestArguments& arguments);

struct StudioArguments {
  std::string folder = ".";
  gable::SearchSettings search;
  int port = 0;
};
int runStudioCommand(const StudioArguments& arguments);
