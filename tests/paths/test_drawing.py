import numpy as np

import optipath as op
from optipath.paths.drawing import draw


def test_nodes_are_drawn_in_the_order_of_travel():
    lines = draw(op.load_preset("npgr026")).splitlines()
    nodes = [line.split()[0] for line in lines if not line.startswith(" ")]
    assert nodes == ["L", "P", "X2", "X1", "E"]


def test_each_link_stands_below_the_node_it_leaves():
    lines = draw(op.load_preset("npgr026")).splitlines()
    assert lines[lines.index("  | reflected --> X1.in") - 1].startswith("X2")
    assert "  | transmitted --> leaves the path" in lines


def test_a_path_with_a_cycle_can_still_be_drawn():
    path = op.PathGraph()
    one, other = path.add("one", op.Polarizer()), path.add("other", op.Rotator(0.5))
    one >> other >> one
    assert "  | out --> one.in" in draw(path).splitlines()


def test_light_is_told_in_numbers_a_matrix_by_its_size_and_a_flag_as_yes_or_no():
    drawn = {name: draw(op.load_preset(name)) for name in op.preset_names()}
    assert "stokes=[1, 1, 0, 0]" in drawn["double-pass-waveplate"]
    assert "matrix=a 4 x 4 matrix  straight=no" in drawn["ellipsometer-rough"]
    assert "parallel=no" in drawn["prism-refraction"]
    assert not [name for name, text in drawn.items() if "array" in text]


def test_many_numbers_are_counted():
    path = op.PathGraph()
    path.add("lamp", op.Source(stokes=np.ones((3, 5, 4)) * [1.0, 0.0, 0.0, 0.5]))
    assert "stokes=array of shape (3, 5, 4)" in draw(path)
