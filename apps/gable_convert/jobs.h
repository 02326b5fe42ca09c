// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What gable-convert does with the library of each format. What is not built is not there: a
// definition of CMake's (GABLE_ASSIMP, GABLE_DRACO, GABLE_MESHOPT) tells.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// A model (fbx, dae) as OBJ. Throws what is wrong with it.
std::string modelAsObj(const std::string& format, const std::string& bytes);

/// Numbers of the stream between gable and this program: 32 bits, the lowest byte first.
void putWord(std::string& out, uint32_t v);

/// A Draco mesh: the number of points and of triangles, the triangles, the number of attributes,
/// and for each its identifier, its components and its numbers as floats. False when it is broken.
bool unpackDraco(std::string_view bytes, std::string& out);

enum class Meshopt : uint32_t { Vertices = 1, Triangles = 2, Indices = 3 };
enum class MeshoptFilter : uint32_t { None = 0, Octahedral = 1, Quaternion = 2, Exponential = 3 };
/// `count` elements of `stride` bytes. False when they are broken.
bool unpackMeshopt(Meshopt mode, uint32_t count, uint32_t stride, MeshoptFilter filter,
                   std::string_view bytes, std::string& out);
