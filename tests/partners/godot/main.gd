# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The Gable authors
#
# Shows model.glb and lets balls fall on it. GABLE_SHOT names the picture that is taken after so many
# seconds, as the camera of GABLE_EYE and GABLE_TARGET sees it: "x,y,z" in metres.
extends Spatial

const SECONDS = 7.0

func place(name):
	var n = OS.get_environment(name).split_floats(",")
	return Vector3(n[0], n[1], n[2])

func _ready():
	add_child(load("res://model.glb").instance())
	var sun = DirectionalLight.new()
	sun.rotation_degrees = Vector3(-45, 40, 0)
	sun.shadow_enabled = true
	sun.directional_shadow_max_distance = 300
	add_child(sun)
	var camera = Camera.new()
	camera.far = 2000
	camera.fov = 50
	add_child(camera)
	camera.look_at_from_position(place("GABLE_EYE"), place("GABLE_TARGET"), Vector3.UP)
	camera.make_current()
	drop_balls()
	yield(get_tree().create_timer(SECONDS), "timeout")
	yield(VisualServer, "frame_post_draw")
	var image = get_viewport().get_texture().get_data()
	image.flip_y()
	image.save_png(OS.get_environment("GABLE_SHOT"))
	get_tree().quit()

# A grid of balls above the target, of red and white.
func drop_balls():
	var middle = place("GABLE_TARGET")
	for i in range(100):
		var ball = RigidBody.new()
		var shape = CollisionShape.new()
		shape.shape = SphereShape.new()
		shape.shape.radius = 1.0
		ball.add_child(shape)
		var look = MeshInstance.new()
		look.mesh = SphereMesh.new()
		look.mesh.radius = 1.0
		look.mesh.height = 2.0
		look.material_override = SpatialMaterial.new()
		look.material_override.albedo_color = Color(0.9, 0.15, 0.1) if i % 2 == 0 else Color(1, 1, 1)
		ball.add_child(look)
		ball.translation = middle + Vector3((i % 10) * 6 - 27, 55 + i % 3, i / 10 * 6 - 27)
		add_child(ball)
