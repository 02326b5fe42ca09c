// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The options of written models by name, and profiles: choices among them that suit a program which
// opens the model. Command lines, other languages and the reference are made of these tables.
//
//   const auto chosen = gable::chosenWriting("godot", {{"collision", "hull"}});
//   if (chosen.ok) model.write("town.glb", chosen.settings);
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gable/diagnostic.h"
#include "gable/model.h"

namespace gable {

struct WriteOption {
  /// "texture-size".
  std::string name;
  std::string help;
  /// What it takes; empty for a whole number up to `most`.
  std::vector<std::string> words;
  int most = 0;
  /// Endings of the models that it says something about: "glb". "tiles" stands for folders of
  /// tiles.
  std::vector<std::string> formats;
};
const std::vector<WriteOption>& writeOptions();

/// Names and values of options.
using WriteChoices = std::vector<std::pair<std::string, std::string>>;

struct WriteProfile {
  /// "godot".
  std::string name;
  /// "Godot 3 and 4".
  std::string title;
  WriteChoices choices;
};
const std::vector<WriteProfile>& writeProfiles();

struct ChosenWriting {
  bool ok = false;
  WriteSettings settings;
  /// Errors for what there is not; a note for each option that is against the profile.
  DiagnosticList diagnostics;
};
/// The choices of a profile (empty: none) and over them those given.
ChosenWriting chosenWriting(const std::string& profile, const WriteChoices& choices);

/// An error for each option that says nothing about what is written to a path: --lods about an OBJ.
/// Paths that end in '/' are folders of tiles. Paths of no format have none.
DiagnosticList unfitChoices(const std::string& path, const WriteChoices& choices);

/// Why a model cannot be written to a path in this way; empty where it can.
DiagnosticList writeClashes(const std::string& path, const WriteSettings& settings);

}  // namespace gable
