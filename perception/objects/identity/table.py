"""The one table of hypotheses: ways in which each may be true, its gates, and what each evidence weighs.

Priors and weights are in nats. They were chosen so that the scenes of the tests come out right, each of which is a case
that once went wrong in a simulated house; gates are lengths and shares that were measured there.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import log

from perception.objects.identity import evidence as e
from perception.objects.identity.hypotheses import Asked, Evidence, Hypothesis, Row

_FRAME, _MASK, _LEFT, _UNSEEN = (Asked.FRAME,), (Asked.MASK,), (Asked.LEFT,), (Asked.UNSEEN,)
_TENTATIVE, _NODE, _MISSED = (Asked.TENTATIVE,), (Asked.NODE,), (Asked.MISSED,)
_LOOK_ALIKE, _ODDS = 0.02, 2.0
"""Chance of a look-alike where one has looked before and seen nothing; odds that are asked for to call it moved."""
_MOVED = -log(_LOOK_ALIKE * _ODDS)
_LOOKS: Mapping[Evidence, float] = {e.label: 1.0, e.color: 1.0, e.size: 1.0}
_IN_PLACE: Mapping[Evidence, float] = {e.label: 1.15, e.color: 4.6, e.size: 4.6}
_WHEREABOUTS: Mapping[Evidence, float] = {e.left: 1.0, e.at_large: 1.0, e.looked_before: 1.0}

_PIECES = (
    Row(
        asked=(Asked.MASK, Asked.UNSEEN), hypothesis=Hypothesis.NOTHING, way="the arm hides and cuts it", prior=9.0,
        alone=True, yes=(e.small,), most={e.arm_m: 0.25},
    ),
    Row(
        asked=(Asked.MASK, Asked.HOME), hypothesis=Hypothesis.NOTHING, way="a stretch of a wall", prior=9.0,
        alone=True, yes=(e.on_floor,), least={e.in_walls: 0.85},
    ),
    # An end of a book that lies behind a cup. What is as long as the thing may be the whole of it, or in its place.
    Row(
        asked=_MASK, hypothesis=Hypothesis.PART, way="a bit of what is hidden by another", prior=4.0,
        yes=(e.small, e.impenetrable), most={e.sureness: 0.6, e.length_share: 0.6}, least={e.inside: 0.85},
    ),
    # Of a cup before a book, networks at times make one thing.
    Row(
        asked=_MASK, hypothesis=Hypothesis.PART, way="several small things in one mask", prior=5.0,
        alone=True, yes=(e.small, e.nameless), least={e.shared_out: 0.85},
    ),
    Row(
        asked=_LEFT, hypothesis=Hypothesis.NOTHING, way="at the fingers", prior=2.0,
        alone=True, yes=(e.small,), most={e.hand_m: 0.25},
    ),
    Row(
        asked=_LEFT, hypothesis=Hypothesis.PART, way="of furniture that something in front cuts in two", prior=4.0,
        yes=(e.of_furniture,), least={e.label: 0.5, e.inside: 0.6}, weights={e.label: 1.0, e.inside: 1.0},
    ),
    # Two cannot be in one place.
    Row(
        asked=_LEFT, hypothesis=Hypothesis.PART, way="of what is seen whole", prior=4.0,
        yes=(e.of_small, e.seen_now, e.middle_inside), no=(e.container,), least={e.label: 0.5},
    ),
    Row(
        asked=(Asked.TENTATIVE, Asked.NODE, Asked.UNSEEN), hypothesis=Hypothesis.PART, way="of somebody", prior=10.0,
        alone=True, yes=(e.nameless,), most={e.person_m: 0.3},
    ),
    # Of legs alone the network makes the end of a desk or a narrow wardrobe.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="legs of somebody", prior=10.0,
        alone=True, yes=(e.furniture,), most={e.person_m: 0.3, e.sureness: 0.9},
    ),
    # Of a row of furniture, the lower halves often are in one mask.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="several pieces of a row in one", prior=10.0,
        alone=True, yes=(e.furniture,), no=(e.whole,), most={e.sureness: 0.9}, least={e.shared_out: 0.85},
    ),
    # Of the end of a book, networks make scissors.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="a side", prior=10.0,
        yes=(e.small, e.same_room, e.impenetrable, e.enclosed), most={e.thin_m: 0.02},
    ),
    # Were it a piece of that, it would be gone with it. On a thing another may lie, if that is beyond doubt.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="within another", prior=5.5,
        yes=(e.small, e.same_room, e.impenetrable, e.middle_inside), most={e.surely_another: 0.9},
    ),
    Row(
        asked=_UNSEEN, hypothesis=Hypothesis.PART, way="of what is seen there", prior=4.0,
        yes=(e.small, e.nameless, e.seen_now, e.middle_shown), no=(e.container,), least={e.known_sureness: 0.01},
    ),
    Row(
        asked=(Asked.PERSON,), hypothesis=Hypothesis.PART, way="furniture and what stands on it", prior=4.0,
        yes=(e.is_node, e.present, e.of_furniture, e.supports), least={e.over: 0.85},
    ),
)  # fmt: skip

_FURNITURE = (
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="more of the same kind", prior=7.5,
        yes=(e.furniture, e.same_room, e.present, e.same_name), least={e.inside: 0.3}, weights={e.inside: 1.0},
    ),
    # From near, a part of a toilet may look like a bin, and the side of a desk like a shelf, whereas a chair pushed
    # under a table shows itself, and so does a stove in a row of counters.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="never seen whole", prior=4.0,
        yes=(e.furniture, e.same_room, e.present), no=(e.whole,), least={e.inside: 0.9},
    ),
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="of no name to rely on", prior=4.0,
        yes=(e.furniture, e.same_room, e.present), most={e.sureness: 0.9}, least={e.inside: 0.9},
    ),
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.PART, way="both fill one place", prior=4.0,
        yes=(e.furniture, e.same_room, e.present), least={e.inside: 0.5, e.covers: 0.5},
    ),
    # Further frames may show that what seems to be a part is a piece of its own: as likely as not until then.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.NEW, way="perhaps a piece of a row", prior=3.9,
        yes=(e.furniture, e.same_room, e.present, e.fits_row), no=(e.same_name,),
    ),
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.NEW, way="a piece of a row that was taken for one", prior=6.0,
        yes=(e.furniture, e.same_room, e.present, e.fits_row), least={e.sureness: 0.9},
    ),
    # First seen from two sides, or under two names.
    Row(
        asked=_NODE, hypothesis=Hypothesis.PART, way="most of one is in the other", prior=4.0,
        yes=(e.furniture, e.meeting, e.same_name), least={e.inside: 0.5}, weights={e.inside: 1.0},
    ),
    Row(
        asked=_NODE, hypothesis=Hypothesis.PART, way="of no name to rely on, in what is known well", prior=4.0,
        yes=(e.furniture, e.meeting, e.shorter), no=(e.same_name, e.in_longer), most={e.sureness: 0.9},
        least={e.known_sureness: 0.9, e.inside: 0.9},
    ),
    Row(
        asked=_NODE, hypothesis=Hypothesis.PART, way="both fill one place", prior=4.0,
        yes=(e.furniture, e.meeting), no=(e.same_name, e.in_longer), least={e.inside: 0.5, e.covers: 0.5},
    ),
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.MOVED, way="pushed", prior=_MOVED,
        yes=(e.furniture, e.later, e.alike), no=(e.fixed, e.held, e.rivals), most={e.away_m: 1.5},
        weights={**_LOOKS, **_WHEREABOUTS},
    ),
)  # fmt: skip

_THINGS = (
    # Of a mask that was there in the last frame nothing costs more than a wrong name.
    Row(
        asked=_FRAME, hypothesis=Hypothesis.SAME, way="where it was, in the next frame", prior=5.0,
        yes=(e.of_small, e.findable), least={e.place: 0.08, e.kin: 0.3}, weights={e.place: 1.44, e.label: 1.0, e.mask: 2.16},
    ),
    Row(
        asked=_FRAME, hypothesis=Hypothesis.SAME, way="furniture, in the next frame", prior=5.0,
        yes=(e.of_furniture,), least={e.kin: 0.3, e.inside: 0.35}, weights={e.inside: 2.0, e.label: 1.0, e.mask: 2.16},
    ),
    # Half hidden by the hand, it may look like anything.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.SAME, way="where the hand has put it", prior=8.0,
        yes=(e.small, e.awaited, e.touching), least={e.color: 0.4}, weights={e.color: 1.0},
    ),
    # The grasp was a phantom.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.SAME, way="never taken", prior=7.0,
        yes=(e.held, e.alike), most={e.taken_from_m: 0.12}, weights=_LOOKS,
    ),
    # In the very place of a thing its name may differ: half hidden, or from another side, a yellow book looks like a
    # banana. Color and size must agree the better.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.SAME, way="in its place", prior=7.0,
        yes=(e.small, e.touching), no=(e.held,), least={e.unseen_s: 0.3, e.label: 0.1},
        weights={e.label: 1.6, e.color: 6.4, e.size: 6.4, e.present: 0.8},
    ),
    Row(
        asked=_MISSED, hypothesis=Hypothesis.SAME, way="in its place since", prior=5.0,
        yes=(e.small, e.missing, e.touching, e.later), no=(e.put_by_hand,), least={e.label: 0.1}, weights=_IN_PLACE,
    ),
    Row(
        asked=_MISSED, hypothesis=Hypothesis.SAME, way="in its very spot", prior=5.0,
        yes=(e.small, e.missing, e.touching), no=(e.put_by_hand,), least={e.label: 0.1}, most={e.off_middle: 0.4},
        weights=_IN_PLACE,
    ),
    # What lies otherwise than it stood may well be called otherwise.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.MOVED, way="slipped from the hand, or knocked down by it", prior=5.3,
        yes=(e.small, e.missing, e.let_slip, e.later), most={e.away_m: 1.0},
        weights={e.label: 1.36, e.color: 9.8, e.size: 9.8, e.near: 0.5},
    ),
    # Of what has toppled or was knocked down, nobody may be able to say what it is. With a name it is another.
    Row(
        asked=(Asked.TENTATIVE, Asked.MISSED), hypothesis=Hypothesis.MOVED, way="toppled, near by or below", prior=4.3,
        yes=(e.small, e.nameless, e.missing, e.later), no=(e.put_by_hand,), most={e.away_m: 1.0},
        weights={e.color: 7.8, e.size: 7.8, e.near: 0.5},
    ),
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.MOVED, way="carried here while nobody looked", prior=_MOVED + 2.5,
        yes=(e.small, e.later, e.alike, e.may_lie_here), no=(e.held, e.rivals),
        weights={**_LOOKS, **_WHEREABOUTS, e.near: 1.0},
    ),
    # Seen at its new place before it was missed at the old.
    Row(
        asked=_MISSED, hypothesis=Hypothesis.MOVED, way="turned up before it was missed", prior=_MOVED,
        yes=(e.small, e.missing, e.later, e.alike, e.may_lie_here, e.looked_before), no=(e.put_by_hand, e.twins),
        weights=_LOOKS,
    ),
    # A few more frames will tell whether that has moved here.
    Row(
        asked=_TENTATIVE, hypothesis=Hypothesis.LOOK_ALIKE, way="one like it is just being missed", prior=0.1,
        yes=(e.present, e.being_missed, e.later, e.alike),
    ),
)  # fmt: skip

TABLE: tuple[Row, ...] = (*_PIECES, *_FURNITURE, *_THINGS)
