"""The order of ports, and loops among them."""

from optipath.composer.travel import cycles, stretches


def ways(*links):
    found = {}
    for start, end in links:
        found.setdefault((start, "p"), []).append((end, "p"))
        found.setdefault((end, "p"), [])
    return found


def names(ports):
    return [name for name, _ in ports]


def test_ports_come_in_the_order_of_travel_and_else_by_name():
    found = stretches(ways(("c", "a"), ("d", "b"), ("a", "e"), ("b", "e")))
    assert names(s.ports[0] for s in found) == ["c", "a", "d", "b", "e"]


def test_the_ports_of_a_loop_stand_together_with_their_knots_first():
    found = stretches(ways(("in", "b"), ("b", "c"), ("c", "a"), ("a", "b"), ("c", "out")))
    assert [names(s.ports) for s in found] == [["in"], ["b", "c", "a"], ["out"]]
    assert names(found[1].junctions) == ["b"]


def test_loops_that_share_a_port_are_one():
    chained = ways(("in", "a"), ("a", "b"), ("b", "a"), ("b", "c"), ("c", "b"), ("c", "out"))
    assert [set(names(ports)) for ports in cycles(chained)] == [{"a", "b", "c"}]


def test_what_leads_to_a_loop_or_comes_from_it_is_no_part_of_it():
    found = cycles(ways(("in", "x"), ("x", "y"), ("y", "x"), ("y", "out"), ("out", "end")))
    assert [set(names(ports)) for ports in found] == [{"x", "y"}]
