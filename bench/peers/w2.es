// W2 in EisenScript (Structure Synth): 1000 buildings of 100 boxes, all of one size.
set maxobjects 200000
25 * { z 30 } 40 * { x 30 } house
rule house {
  5 * { y 3 } 4 * { x 2.7 } 5 * { z 2.2 } { s 2.7 3 2.2 } box
}
