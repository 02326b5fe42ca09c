# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
"""Materials of a model as materials of Blender: Principled, with their textures packed into the file."""
from math import cos, sin

import bpy

# Sockets that newer versions call otherwise.
SOCKETS = {"Emission": ("Emission Color", "Emission")}
COLUMN = 300
UV_NAMES = "UVMap"
# Marks what a generation has made.
MADE = "gable_made"


def uv_name(number):
    return UV_NAMES if number == 0 else f"{UV_NAMES}.{number:03d}"


def tag(block):
    """Marks a data-block as made by a generation."""
    block[MADE] = True


def load_images(images):
    """Packed: the saved file needs no other."""
    made = []
    for image in images:
        block = bpy.data.images.new(image.name, 8, 8)
        block.pack(data=image.data, data_len=len(image.data))
        block.source = "FILE"
        tag(block)
        made.append(block)
    return made


class _Tree:
    """The nodes of one material."""

    def __init__(self, material, model, images):
        self.tree = material.node_tree
        self.model, self.images = model, images
        self.shader = next(n for n in self.tree.nodes if n.type == "BSDF_PRINCIPLED")
        self.row = 0
        # By texture and place: several channels of one are one node.
        self.known = {}

    def socket(self, name):
        names = SOCKETS.get(name, (name,))
        return next((self.shader.inputs[n] for n in names if n in self.shader.inputs), None)

    def node(self, kind, column):
        made = self.tree.nodes.new(kind)
        made.location = (self.shader.location.x - column * COLUMN, self.shader.location.y - self.row * COLUMN)
        return made

    def link(self, output, input_):
        if input_ is not None:
            self.tree.links.new(output, input_)

    def texture(self, info, is_color):
        """The node of a texture's picture, placed as glTF says."""
        placing = info.get("extensions", {}).get("KHR_texture_transform", {})
        key = (info["index"], is_color, str(placing))
        if key in self.known:
            return self.known[key]
        node = self.node("ShaderNodeTexImage", 2)
        node.image = self.images[self.model.textures[info["index"]]]
        if not is_color:
            node.image.colorspace_settings.name = "Non-Color"
        uv = self.node("ShaderNodeUVMap", 4)
        uv.uv_map = uv_name(info.get("texCoord", 0))
        if placing:
            mapping = self.node("ShaderNodeMapping", 3)
            turn, scale = placing.get("rotation", 0), placing.get("scale", (1, 1))
            x, y = placing.get("offset", (0, 0))
            # glTF counts v downwards.
            mapping.inputs["Location"].default_value = (x + scale[1] * sin(turn), 1 - y - scale[1] * cos(turn), 0)
            mapping.inputs["Rotation"].default_value = (0, 0, turn)
            mapping.inputs["Scale"].default_value = (scale[0], scale[1], 1)
            self.link(uv.outputs["UV"], mapping.inputs["Vector"])
            self.link(mapping.outputs["Vector"], node.inputs["Vector"])
        else:
            self.link(uv.outputs["UV"], node.inputs["Vector"])
        self.row += 1
        self.known[key] = node
        return node


def _set_color(tree, plain):
    factor = plain.get("baseColorFactor", (1, 1, 1, 1))
    base, alpha = tree.socket("Base Color"), tree.socket("Alpha")
    base.default_value = factor
    alpha.default_value = factor[3]
    if "baseColorTexture" not in plain:
        return
    texture = tree.texture(plain["baseColorTexture"], True)
    color = texture.outputs["Color"]
    if tuple(factor[:3]) != (1, 1, 1):
        mix = tree.node("ShaderNodeVectorMath", 1)
        mix.operation = "MULTIPLY"
        mix.inputs[1].default_value = factor[:3]
        tree.link(color, mix.inputs[0])
        color = mix.outputs[0]
    tree.link(color, base)
    if factor[3] == 1:
        tree.link(texture.outputs["Alpha"], alpha)


def _set_roughness(tree, plain):
    tree.socket("Metallic").default_value = plain.get("metallicFactor", 1)
    tree.socket("Roughness").default_value = plain.get("roughnessFactor", 1)
    if "metallicRoughnessTexture" in plain:
        texture = tree.texture(plain["metallicRoughnessTexture"], False)
        parts = tree.node("ShaderNodeSeparateColor", 1)
        tree.link(texture.outputs["Color"], parts.inputs[0])
        tree.link(parts.outputs[1], tree.socket("Roughness"))
        tree.link(parts.outputs[2], tree.socket("Metallic"))


def _set_rest(tree, info):
    if "normalTexture" in info:
        bump = tree.node("ShaderNodeNormalMap", 1)
        bump.inputs["Strength"].default_value = info["normalTexture"].get("scale", 1)
        tree.link(tree.texture(info["normalTexture"], False).outputs["Color"], bump.inputs["Color"])
        tree.link(bump.outputs["Normal"], tree.socket("Normal"))
    emission = info.get("emissiveFactor")
    if emission:
        tree.socket("Emission").default_value = (*emission, 1)
        tree.socket("Emission Strength").default_value = 1
    if "emissiveTexture" in info:
        tree.link(tree.texture(info["emissiveTexture"], True).outputs["Color"], tree.socket("Emission"))


def make(model, images):
    """One for each of the model's."""
    made = []
    for info in model.materials:
        material = bpy.data.materials.new(info.get("name", "Gable"))
        tag(material)
        material.use_nodes = True
        plain = info.get("pbrMetallicRoughness", {})
        tree = _Tree(material, model, images)
        _set_color(tree, plain)
        _set_roughness(tree, plain)
        _set_rest(tree, info)
        material.diffuse_color = plain.get("baseColorFactor", (1, 1, 1, 1))
        material.use_backface_culling = not info.get("doubleSided", False)
        mode = info.get("alphaMode", "OPAQUE")
        if mode != "OPAQUE" and hasattr(material, "blend_method"):
            material.blend_method = "CLIP" if mode == "MASK" else "BLEND"
        made.append(material)
    return made
