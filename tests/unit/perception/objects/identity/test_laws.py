"""Laws of the table of hypotheses, whatever numbers it holds."""

import logging
import math
from inspect import getmembers

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.objects.identity import evidence
from perception.objects.identity.hypotheses import Asked, Hypothesis
from perception.objects.identity.identity import Identity, IdentitySettings
from perception.objects.identity.pair import Moment, Pair, Subject
from perception.objects.identity.table import TABLE
from scene_graph.nodes import ObjectState
from unit.perception.objects.things import IDENTITY, decision, thing

FLOOR = IdentitySettings().floor
WEIGHED = [row for row in TABLE if row.weights]
IS_THAT = {Hypothesis.SAME, Hypothesis.MOVED}
LOOKS = st.tuples(
    st.sampled_from(("bottle", "cup", "unknown")),
    st.sampled_from(("blue", "red")),
    st.sampled_from(((0.07, 0.07, 0.24), (0.08, 0.08, 0.1), (0.2, 0.09, 0.03))),
)
PLACES = st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5), st.floats(0.0, 0.5))


def placed(number, look, at, **more):
    track = thing(number, *look, **more)
    track.put_at("room_1", np.array(at), 0.01)
    track.node_id = f"thing_{number}"
    return track


def assumed(values):
    """A pair of which some evidence is as assumed."""
    pair = Pair(Subject.of(thing(1)), thing(2), Moment())
    pair.measured.update(values)
    return pair


@given(st.lists(st.tuples(LOOKS, PLACES, st.booleans()), min_size=1, max_size=5), LOOKS, st.randoms())
def test_what_it_is_does_not_depend_on_the_order_of_what_is_known(others, look, random):
    known = [
        placed(n, other, at, state=ObjectState.MISSING if missed else ObjectState.PRESENT)
        for n, (other, at, missed) in enumerate(others)
    ]
    sighting = placed(99, look, (0.0, 0.0, 0.0), seen=(20.0, 21.0))
    shuffled = random.sample(known, len(known))
    one, other = (decision(sighting, each, looked_before={"room_1": 0.0}) for each in (known, shuffled))
    assert [(c.hypothesis, c.known, c.way, c.score) for c in one.claims] == [
        (c.hypothesis, c.known, c.way, c.score) for c in other.claims
    ]
    assert one.waits is other.waits


@given(LOOKS, PLACES)
def test_what_looks_like_a_thing_that_is_no_longer_seen_in_its_very_place_is_that_thing(look, at):
    known = placed(1, look, at)
    decided = decision(placed(2, look, at, seen=(20.0, 21.0)), [known])
    assert decided.best.hypothesis is Hypothesis.SAME
    assert decided.best.known is known
    assert not decided.waits


@given(LOOKS, LOOKS, PLACES, st.sampled_from((Asked.TENTATIVE, Asked.MISSED)), st.booleans())
def test_two_that_are_seen_at_the_same_time_are_never_one(look, other, at, asked, looked):
    known, sighting = placed(1, look, (0.0, 0.0, 0.0), seen=(0.0, 21.0)), placed(2, other, at, seen=(20.0, 21.0))
    before = {"room_1": 0.0} if looked else {}
    claims = decision(sighting, [known], asked, looked_before=before).claims
    assert not [claim for claim in claims if claim.hypothesis in IS_THAT]


@pytest.mark.parametrize("row", WEIGHED, ids=lambda row: row.way)
@given(st.data())
def test_evidence_that_agrees_better_never_lowers_a_hypothesis_nor_shuts_it_out(row, data):
    shares = st.floats(0.0, 1.0)
    worse = {each: data.draw(shares) for each in row.weights}
    better = {each: data.draw(st.floats(value, 1.0)) for each, value in worse.items()}
    gates = {each: low if low > -math.inf else high for each, low, high in row.gates}
    one, other = assumed(gates | worse), assumed(gates | better)
    assert row.claim(one, FLOOR).score <= row.claim(other, FLOOR).score + 1e-9
    assert row.admits(other) >= row.admits(one)


@pytest.mark.parametrize("row", WEIGHED, ids=lambda row: row.way)
def test_where_everything_agrees_only_the_prior_counts_and_no_evidence_is_certain_to_be_wrong(row):
    assert all(weight > 0.0 for weight in row.weights.values())
    agrees, denies = (row.claim(assumed(dict.fromkeys(row.weights, value)), FLOOR).score for value in (1.0, 0.0))
    assert agrees == pytest.approx(row.prior)
    assert denies == pytest.approx(row.prior + math.log(FLOOR) * sum(row.weights.values()))


def test_no_way_is_in_the_table_twice_for_one_question_and_every_evidence_is_asked_for():
    ways = [(asked, row.hypothesis, row.way) for row in TABLE for asked in row.asked]
    assert len(ways) == len(set(ways))
    asked_for = {each for row in TABLE for each in (*row.weights, *(gate[0] for gate in row.gates))}
    own = [f for _, f in getmembers(evidence, callable) if getattr(f, "__module__", "") == evidence.__name__]
    unused = {f.__name__ for f in own if f not in asked_for and not f.__name__.startswith("_")}
    assert unused == {"fact", "likeness", "apart_m", "since_s"}, "of these, others are made"


def test_nothing_that_is_known_leaves_something_new():
    decided = decision(thing(1, seen=(20.0, 21.0)), [])
    assert [claim.hypothesis for claim in decided.claims] == [Hypothesis.NEW]
    assert not decided.waits


@pytest.mark.parametrize("margin", [0.0, 100.0])
def test_one_waits_where_the_best_leads_by_less_than_the_margin(margin):
    identity = Identity(IdentitySettings(margin=margin))
    missing, sighting = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    assert identity.decide(Asked.TENTATIVE, Subject.of(sighting), Moment(known=[missing])).waits is (margin > 0.0)


def test_a_decision_tells_its_hypotheses_with_scores_and_evidence_by_name(caplog):
    missing, sighting = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    missing.node_id = "bottle_1"
    with caplog.at_level(logging.DEBUG):
        decided = IDENTITY.decide(Asked.TENTATIVE, Subject.of(sighting), Moment(known=[missing]))
    assert decided.best.evidence["label"] == pytest.approx(1.0, abs=0.01)
    assert decided.best.evidence["missing"] == 1.0
    assert "same bottle_1 (in its place)" in caplog.text
    assert "color 1" in caplog.text
    assert "new (nothing speaks for another) 0.00" in caplog.text
