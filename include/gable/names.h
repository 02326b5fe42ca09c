// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The words for values of the interface, as command lines and files write them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gable/dataset.h"
#include "gable/diagnostic.h"
#include "gable/model.h"

namespace gable {

/// "note", "warning" or "error".
const char* severityName(Diagnostic::Severity severity);

/// "iso", "top", "front", "street": in the order of the views.
const std::vector<std::string>& viewNames();
/// Absent for any other word.
std::optional<View> viewNamed(const std::string& name);
/// "photo", "clay", "blueprint", "ink", "section", in the order of Look.
const std::vector<std::string>& lookNames();
/// Empty where there is no such look.
std::optional<Look> lookNamed(const std::string& name);
/// "paths", "direct": in the order of Lighting.
const std::vector<std::string>& lightingNames();
std::optional<Lighting> lightingNamed(const std::string& name);

/// "auto", "nodes", "gpu", "none": in the order of Instancing.
const std::vector<std::string>& instancingNames();
std::optional<Instancing> instancingNamed(const std::string& name);

/// "auto", "float", "compact", "bare": in the order of Vertices.
const std::vector<std::string>& verticesNames();
std::optional<Vertices> verticesNamed(const std::string& name);

/// "all", "1", "2", "3": in the order of Detail.
const std::vector<std::string>& detailNames();
std::optional<Detail> detailNamed(const std::string& name);

/// "orbit", "sampled": in the order of DatasetCameras.
const std::vector<std::string>& datasetCamerasNames();
std::optional<DatasetCameras> datasetCamerasNamed(const std::string& name);
/// "rule", "label", "tag": in the order of DatasetLabels.
const std::vector<std::string>& datasetLabelsNames();
std::optional<DatasetLabels> datasetLabelsNamed(const std::string& name);
/// "coco", "json": in the order of DatasetFormat.
const std::vector<std::string>& datasetFormatNames();
std::optional<DatasetFormat> datasetFormatNamed(const std::string& name);

}  // namespace gable
