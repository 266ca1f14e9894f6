"""The one table of hypotheses: ways in which each may be true, its gates, and what each evidence weighs.

Priors and weights are in nats. They were chosen so that the scenes of the tests come out right, each of which is a case
that once went wrong in a simulated house; gates are lengths and shares that were measured there.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import log

from perception.objects.identity import evidence as e
from perception.objects.identity.hypotheses import Asked, Hypothesis, Row
from perception.objects.identity.pair import Evidence

_FRAME, _MASK, _LEFT, _UNSEEN = (Asked.FRAME,), (Asked.MASK,), (Asked.LEFT,), (Asked.UNSEEN,)
_TENTATIVE, _NODE, _MISSED = (Asked.TENTATIVE,), (Asked.NODE,), (Asked.MISSED,)
SAME, PART, MOVED, LOOK_ALIKE, NEW, NOTHING = Hypothesis
_LOOK_ALIKE, _ODDS = 0.02, 2.0
"""Chance of a look-alike where one has looked before and seen nothing; odds that are asked for to call it moved."""
_MOVED = -log(_LOOK_ALIKE * _ODDS)
_LOOKS: Mapping[Evidence, float] = {e.label: 1.0, e.color: 1.0, e.size: 1.0}
_IN_PLACE: Mapping[Evidence, float] = {e.label: 1.15, e.color: 4.6, e.size: 4.6}
_WHEREABOUTS: Mapping[Evidence, float] = {e.left: 1.0, e.at_large: 1.0, e.looked_before: 1.0}

_PIECES = (
    Row((Asked.MASK, Asked.UNSEEN), NOTHING, "the arm hides and cuts it", 9.0, alone=True,
        yes=(e.small,), most={e.arm_m: 0.25}),
    Row((Asked.MASK, Asked.HOME), NOTHING, "a stretch of a wall", 9.0, alone=True,
        yes=(e.on_floor,), least={e.in_walls: 0.85}),
    # An end of a book that lies behind a cup. What is as long as the thing may be the whole of it, or in its place.
    Row(_MASK, PART, "a bit of what is hidden by another", 4.0,
        yes=(e.small, e.impenetrable), most={e.sureness: 0.6, e.length_share: 0.6}, least={e.inside: 0.85}),
    # Of a cup before a book, networks at times make one thing.
    Row(_MASK, PART, "several small things in one mask", 5.0, alone=True,
        yes=(e.small, e.nameless), least={e.shared_out: 0.85}),
    Row(_LEFT, NOTHING, "at the fingers", 2.0, alone=True,
        yes=(e.small,), most={e.hand_m: 0.25}),
    Row(_LEFT, PART, "of furniture that something in front cuts in two", 4.0,
        yes=(e.of_furniture,), least={e.label: 0.5, e.inside: 0.6}, weights={e.label: 1.0, e.inside: 1.0}),
    # Two cannot be in one place.
    Row(_LEFT, PART, "of what is seen whole", 4.0,
        yes=(e.seen_now, e.middle_inside), no=(e.of_furniture, e.container), least={e.label: 0.5}),
    Row((Asked.TENTATIVE, Asked.NODE, Asked.UNSEEN), PART, "of somebody", 10.0, alone=True,
        yes=(e.nameless,), most={e.person_m: 0.3}),
    # Of legs alone the network makes the end of a desk or a narrow wardrobe.
    Row(_TENTATIVE, PART, "legs of somebody", 10.0, alone=True,
        yes=(e.furniture,), most={e.person_m: 0.3, e.sureness: 0.9}),
    # Of a row of furniture, the lower halves often are in one mask.
    Row(_TENTATIVE, PART, "several pieces of a row in one", 10.0, alone=True,
        yes=(e.furniture,), no=(e.whole,), most={e.sureness: 0.9}, least={e.shared_out: 0.85}),
    # Of the end of a book, networks make scissors.
    Row(_TENTATIVE, PART, "a side", 10.0,
        yes=(e.small, e.same_room, e.impenetrable, e.enclosed), most={e.thin_m: 0.02}),
    # Were it a piece of that, it would be gone with it. On a thing another may lie, if that is beyond doubt.
    Row(_TENTATIVE, PART, "within another", 5.5,
        yes=(e.small, e.same_room, e.impenetrable, e.middle_inside), most={e.surely_another: 0.9}),
    Row(_UNSEEN, PART, "of what is seen there", 4.0,
        yes=(e.small, e.nameless, e.seen_now, e.middle_shown), no=(e.container,), least={e.known_sureness: 0.01}),
    Row(_UNSEEN, PART, "where another stands now", 4.0,
        yes=(e.small, e.same_room, e.seen_now, e.stands_there), no=(e.container,)),
    Row((Asked.PERSON,), PART, "furniture and what stands on it", 4.0,
        yes=(e.is_node, e.present, e.of_furniture, e.supports), least={e.over: 0.85}),
)  # fmt: skip

_FURNITURE = (
    Row(_TENTATIVE, PART, "more of the same kind", 7.5,
        yes=(e.furniture, e.same_room, e.present, e.same_name), least={e.inside: 0.3}, weights={e.inside: 1.0}),
    # From near, a part of a toilet may look like a bin, and the side of a desk like a shelf, whereas a chair pushed
    # under a table shows itself, and so does a stove in a row of counters.
    Row(_TENTATIVE, PART, "never seen whole", 4.0,
        yes=(e.furniture, e.same_room, e.present), no=(e.whole,), least={e.inside: 0.9}),
    Row(_TENTATIVE, PART, "of no name to rely on", 4.0,
        yes=(e.furniture, e.same_room, e.present), most={e.sureness: 0.9}, least={e.inside: 0.9}),
    Row(_TENTATIVE, PART, "both fill one place", 5.4,
        yes=(e.furniture, e.same_room, e.present), least={e.inside: 0.5, e.covers: 0.5},
        weights={e.inside: 1.0, e.covers: 1.0}),
    # Further frames may show that what seems to be a part is a piece of its own: as likely as not until then.
    Row(_TENTATIVE, NEW, "perhaps a piece of a row", 3.9,
        yes=(e.furniture, e.same_room, e.present, e.fits_row), no=(e.same_name,)),
    Row(_TENTATIVE, NEW, "a piece of a row that was taken for one", 6.0,
        yes=(e.furniture, e.same_room, e.present, e.fits_row), least={e.sureness: 0.9}),
    # First seen from two sides, or under two names.
    Row(_NODE, PART, "most of one is in the other", 4.0,
        yes=(e.furniture, e.meeting, e.same_name), least={e.inside: 0.5}, weights={e.inside: 1.0}),
    Row(_NODE, PART, "of no name to rely on, in what is known well", 4.0,
        yes=(e.furniture, e.meeting, e.shorter), no=(e.same_name, e.in_longer), most={e.sureness: 0.9},
        least={e.known_sureness: 0.9, e.inside: 0.9}),
    Row(_NODE, PART, "both fill one place", 4.0,
        yes=(e.furniture, e.meeting), no=(e.same_name, e.in_longer), least={e.inside: 0.5, e.covers: 0.5}),
    Row(_TENTATIVE, MOVED, "pushed", _MOVED,
        yes=(e.furniture, e.later, e.alike), no=(e.fixed, e.held, e.rivals), most={e.away_m: 1.5},
        weights={**_LOOKS, **_WHEREABOUTS}),
)  # fmt: skip

_THINGS = (
    # Of a mask that was there in the last frame nothing costs more than a wrong name.
    Row(_FRAME, SAME, "where it was, in the next frame", 5.0,
        yes=(e.findable,), no=(e.of_furniture,), least={e.place: 0.08, e.kin: 0.3},
        weights={e.place: 1.44, e.label: 1.0, e.mask: 2.16}),
    Row(_FRAME, SAME, "furniture, in the next frame", 5.0,
        yes=(e.of_furniture,), least={e.kin: 0.3, e.inside: 0.35},
        weights={e.inside: 2.5, e.label: 1.0, e.mask: 2.16}),
    # Half hidden by the hand, it may look like anything.
    Row(_TENTATIVE, SAME, "where the hand has put it", 8.0,
        yes=(e.small, e.awaited, e.touching), least={e.color: 0.4}, weights={e.color: 1.0}),
    # The grasp was a phantom.
    Row(_TENTATIVE, SAME, "never taken", 7.0,
        yes=(e.held, e.alike), most={e.taken_from_m: 0.12}, weights=_LOOKS),
    # In the very place of a thing its name may differ: half hidden, or from another side, a yellow book looks like a
    # banana. Color and size must agree the better.
    Row(_TENTATIVE, SAME, "in its place", 7.0,
        yes=(e.small, e.touching), no=(e.held,), least={e.unseen_s: 0.3, e.label: 0.1},
        weights={e.label: 1.6, e.color: 6.4, e.size: 6.4, e.present: 0.8}),
    Row(_MISSED, SAME, "in its place since", 5.0,
        yes=(e.small, e.missing, e.touching, e.later), no=(e.put_by_hand,), least={e.label: 0.1}, weights=_IN_PLACE),
    Row(_MISSED, SAME, "in its very spot", 5.0,
        yes=(e.small, e.missing, e.touching), no=(e.put_by_hand,), least={e.label: 0.1}, most={e.off_middle: 0.4},
        weights=_IN_PLACE),
    # What lies otherwise than it stood may well be called otherwise.
    Row(_TENTATIVE, MOVED, "slipped from the hand, or knocked down by it", 5.3,
        yes=(e.small, e.missing, e.let_slip, e.later), most={e.away_m: 1.0},
        weights={e.label: 1.36, e.color: 9.8, e.size: 9.8, e.near: 0.5}),
    # Of what has toppled or was knocked down, nobody may be able to say what it is. With a name it is another.
    Row((Asked.TENTATIVE, Asked.MISSED), MOVED, "toppled, near by or below", 4.3,
        yes=(e.small, e.nameless, e.missing, e.later), no=(e.put_by_hand,), most={e.away_m: 1.0},
        weights={e.color: 7.8, e.size: 7.8, e.near: 0.5}),
    Row(_TENTATIVE, MOVED, "carried here while nobody looked", _MOVED + 2.5,
        yes=(e.small, e.later, e.alike, e.may_lie_here), no=(e.held, e.rivals),
        weights={**_LOOKS, **_WHEREABOUTS, e.near: 1.0}),
    # Seen at its new place before it was missed at the old.
    Row(_MISSED, MOVED, "turned up before it was missed", _MOVED,
        yes=(e.small, e.missing, e.later, e.alike, e.may_lie_here, e.looked_before), no=(e.put_by_hand, e.twins),
        weights=_LOOKS),
    # A few more frames will tell whether that has moved here.
    Row(_TENTATIVE, LOOK_ALIKE, "one like it is just being missed", 0.1,
        yes=(e.present, e.being_missed, e.later, e.alike)),
)  # fmt: skip

TABLE: tuple[Row, ...] = (*_PIECES, *_FURNITURE, *_THINGS)
