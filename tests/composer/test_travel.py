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


def test_ports_come_in_the_order_of_travel_and_those_of_a_loop_together():
    found = stretches(ways(("c", "a"), ("d", "b"), ("a", "e"), ("b", "e")))
    assert names(s.ports[0] for s in found) == ["c", "a", "d", "b", "e"]
    found = stretches(ways(("in", "b"), ("b", "c"), ("c", "a"), ("a", "b"), ("c", "out")))
    assert [names(s.ports) for s in found] == [["in"], ["b", "c", "a"], ["out"]]
    assert names(found[1].junctions) == ["b"]
    chained = ways(("in", "a"), ("a", "b"), ("b", "a"), ("b", "c"), ("c", "b"), ("c", "out"))
    assert [set(names(ports)) for ports in cycles(chained)] == [{"a", "b", "c"}]
    found = cycles(ways(("in", "x"), ("x", "y"), ("y", "x"), ("y", "out"), ("out", "end")))
    assert [set(names(ports)) for ports in found] == [{"x", "y"}]
