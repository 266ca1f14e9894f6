from hypothesis import given, settings
from hypothesis import strategies as st

from scene_graph.identifiers import is_well_formed, natural_key, next_id, slug
from scene_graph.nodes import NodeType
from scene_graph.tables.catalog import Catalog
from scene_graph.tables.revisions import Revisions

law = settings(max_examples=100)
identifiers = st.from_regex(r"[a-c]?[0-9_]{0,4}[a-c]?[0-9]{0,3}", fullmatch=True).filter(bool)


@law
@given(st.text(), st.integers(0, 999), st.integers(0, 999))
def test_numbers_sort_by_value(stem, a, b):
    a_key, b_key = natural_key(f"{stem}_{a}"), natural_key(f"{stem}_{b}")
    assert (a_key < b_key) == (a < b)


@law
@given(st.text(max_size=20), st.integers(0, 5))
def test_the_next_identifier_is_well_formed_and_the_first_free_one(label, taken):
    others = {f"{slug(label)}_{i + 1}" for i in range(taken)}
    chosen = next_id(others, label)
    assert is_well_formed(chosen)
    assert chosen == f"{slug(label)}_{taken + 1}"


@law
@given(st.lists(st.tuples(st.sets(identifiers, max_size=25), st.sets(identifiers, max_size=25)), max_size=5))
def test_a_catalog_kept_up_to_date_is_a_sorted_set(changes):
    catalog, known = Catalog(), set()
    for come, go in changes:
        come, go = come - known, go & known
        catalog = catalog.updated(
            [(NodeType.OBJECT, i) for i in sorted(come)], [(NodeType.OBJECT, i) for i in sorted(go)]
        )
        known = (known - go) | come
        assert catalog.ids(NodeType.OBJECT) == tuple(sorted(known, key=lambda i: (natural_key(i), i)))


@law
@given(st.lists(st.tuples(st.sets(st.integers(0, 400), max_size=60), st.sets(st.integers(0, 400), max_size=5))))
def test_revisions_remember_the_last_write(history):
    revisions, expected = Revisions(), {}
    for number, (written, removed) in enumerate(history, start=1):
        revisions = revisions.updated(written, removed - written, number)
        expected = {key: r for key, r in expected.items() if key not in removed} | dict.fromkeys(written, number)
        assert {key: revisions.of(key) for key in expected} == expected
