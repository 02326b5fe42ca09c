# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Whether the bodies that Godot has made of model.glb stop what falls: a ray downwards, onto the middle of each place
# of GABLE_RAYS, "x,z,height;...", has to stop at that height, or as near to it as GABLE_NEAR.
extends SceneTree

func count(node, what):
	var n = 1 if node.is_class(what) else 0
	for child in node.get_children():
		n += count(child, what)
	return n

func _initialize():
	var scene = load("res://model.glb")
	if scene == null:
		print("check: there is no model")
		quit(1)
		return
	var model = scene.instance()
	root.add_child(model)
	yield(self, "physics_frame")
	yield(self, "physics_frame")
	var space = root.world.direct_space_state
	var wrong = 0
	var near = float(OS.get_environment("GABLE_NEAR"))
	for place in OS.get_environment("GABLE_RAYS").split(";"):
		var n = place.split_floats(",")
		var hit = space.intersect_ray(Vector3(n[0], 100, n[1]), Vector3(n[0], -100, n[1]))
		var height = hit.position.y if hit else -100.0
		if abs(height - n[2]) > near:
			print("check: at %s, %s a ray stops at %s, not at %s" % [n[0], n[1], height, n[2]])
			wrong += 1
	print("check: %d bodies, %d meshes, %d wrong" % [count(model, "StaticBody"), count(model, "MeshInstance"), wrong])
	quit(1 if wrong > 0 else 0)
