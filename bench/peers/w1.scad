// W1 in OpenSCAD: a facade on four sides, 4000 boxes.
module facade(w) {
  bay = w / 10;
  for (f = [0:19]) for (i = [0:9]) translate([i * bay, 0, f * 3]) {
    cube([0.15, 0.2, 3]);
    translate([0.15, 0, 0]) cube([bay - 0.3, 0.2, 0.15]);
    translate([0.15, 0, 0.15]) cube([bay - 0.3, 0.05, 2.7]);
    translate([0.15, 0, 2.85]) cube([bay - 0.3, 0.2, 0.15]);
    translate([bay - 0.15, 0, 0]) cube([0.15, 0.2, 3]);
  }
}
translate([30, 0, 0]) rotate(180) facade(30);
translate([30, 20, 0]) rotate(-90) facade(20);
translate([0, 20, 0]) facade(30);
rotate(90) facade(20);
