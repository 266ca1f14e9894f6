"""What is said about the request before: *no, the red one*, *do it again*, *the other cup too*, *no, on the desk*."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from planner.dialogue.carrying import placing_predicate
from planner.dialogue.meaning import Meaning
from planner.dialogue.semantics import Outcome, Semantics
from planner.dialogue.settings import DialogueSettings
from planner.goals import PLACING, Goal, Predicate
from planner.grounding.context import Context
from planner.grounding.grounding import Grounding
from planner.language.grammar.syntax import Carry, NounPhrase, Pronoun, Step
from planner.language.lexicon.vocabulary import COLORS, normal
from planner.language.lexicon.words import NUMBERS
from planner.plan import Exchange
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode

_COURTESY = (
    r"(?:(?:i am (?:so |very |terribly )?sorry|i'm (?:so |very )?sorry|sorry|oops|wait|hm+|um|ah|oh|hang on|hold on"
    r"|excuse me|please|ok|okay|well|stop)\b[\s,.!:;–-]*)*"
)
_THANKED = re.compile(
    r"^(?:(?:thanks|thank you|thx|cheers|great|good|perfect|fine|nice|lovely|wonderful|excellent|well done|ok"
    r"|okay|right"
    r"|alright|all right|very good|many thanks)(?: (?:so much|a lot|very much|job|work|robot"
    r"|then))*[,.!;]+\s*)+(?=\w)"
)
"""Praise before the next request."""
_TRAILING = re.compile(
    r"[\s,]+(?:(?:would|will|might) be (?:better|best|nicer|good|great|fine|preferable)|(?:will"
    r"|would|should) do|is better|instead|please"
    r"|rather|actually|i mean|i meant|(?:that)?(?: is|'s)?(?: what)?[\s,]*\bi (?:wanted|meant|said|was trying"
    r"|tried|intended)(?: to say)?"
    r"|(?:it )?should (?:have been|be)|was what i meant|of course|obviously|not the other(?: one)?)[\s.!]*$"
)
_LED = re.compile(rf"^{_COURTESY}")
_DENIED = re.compile(r"^(?:(?:no+|nope|not that|wait|oh|sorry)[\s,.!]+)+(?=\w)")
_SAID = re.compile(r"^(?:i|we) (?:meant|mean|said)(?: to say)?[\s,:]+")
_FORGOTTEN = re.compile(r"^(?:forget|skip|never mind)(?: about)? (?:the|that|my) [\w ]+?[,;.]+ *(?:and |just )*")
_MADE = re.compile(r"^(?:make (?:it|that)|let us make it|i mean)[\s,]+(?=\w)")
_NO = re.compile(
    rf"^{_COURTESY}(?:no+|nope|not (?:that|this)(?: one)?"
    r"|not (?:to|on|in|into|onto|at) [\w ]+?(?=[,;.])|not \w+(?: ones?)?(?=[,;.] )"
    r"|(?:forget|skip|never mind)(?: about)? (?:the|that|my) [\w ]+?(?=[,;.])"
    r"|change of plans?(?=[:,.])"
    r"|did i (?:just )?say [\w ]+?(?=\?)"
    r"|(?:that|this|it)(?: is| was|'s) (?:the )?wrong(?: \w+)?(?=[,;.!-])"
    r"|you (?:have |'ve )?(?:got|brought|took|taken|picked|have|fetched) (?:me )?the wrong(?: \w+)?(?=[,;.!-])"
    r"|instead of [\w ]+?(?:,|(?= (?:take|bring|give|put|use|the)\b))"
    r"(?:\s*(?:take|bring|give|put|use)\b(?: me| him| her)?)?|wrong(?: (?!is\b)\w+)?|that(?: is|'s) wrong|not "
    r"the \w+(?: one)?)\b"
    r"[\s,.!?:;–-]*(?:sorry[\s,]*)?(?:(?:i|we) (?:meant|mean|said|wanted|want)\b(?! you\b)(?: to "
    r"say)?[\s,]*)?(?P<rest>.*)$"
)
_REPAIR = re.compile(
    r"^(?P<said>.+?)(?:[\s,.;:!…–—-]+(?:forget (?:it|that)|on second thoughts?|come to think of it"
    r"|i mean(?:t)?(?: to say)?|no,? (?:sorry|wait)|(?:sorry|wait),? no|scratch that"
    r"|strike that|scrap that|or rather|make that"
    r"|no,? i mean(?:t)?|correction)\b|\s*(?:[,.;:!…]+|\s[-–—])\s*(?:(?:oh|ah|oops|uh|um|er+"
    r"|hm+|or)\b[\s,]*)?(?:i(?: a|')m (?:so |very |terribly )?sorry|err?|erm|uh+|um+|oops|no|sorry|actually"
    r"|rather|wait|oops|make it|not "
    r"that"
    r"|well|hang on|hold on)\b(?!\s+(?:matter|problem|rush|hurry|one|longer)))+[\s,.;:!…-]*(?P<rest>.+)$"
)
_SLIP = (
    r"(?:no|nope|wait|sorry|pardon(?: me)?|excuse me|i (?:do )?mean(?:t)?(?: to say)?|rather"
    r"|better|actually|make (?:it|that)|scratch that|correction|not that|"
    r"my (?:bad|mistake)|hang on|hold on|oops|whoops|what am i saying|forget (?:it|that)|(?:strike|scrap) that"
    r"|(?:i )?should say|let"
    r" us say)"
)
_BARE = re.compile(
    rf"^(?P<said>.+?\w)[\s,.;:!…–-]+(?:(?:or|oh|ah|uh|um|er|hm+|and|but|well|hmm+)[\s,]+)*(?:no"
    rf"(?=,? (?:the|an?|my|to|in|on|into|onto|at|next|(?:just )?(?:put|take|bring|leave|give) (?:it|them))\b)"
    r"|or no|or rather|or actually|or better(?: yet| still)?"
    rf"|pardon me|pardon|excuse me|no,? better|no,? rather|actually,? (?:no"
    rf"|make (?:it|that))|make (?:it|that)|no,? make (?:it|that)|(?<=, )i mean|better"
    r"|(?<=\w )sorry(?=,? (?!for|to|about|but|i|if|you)\w))"
    rf"(?:[\s,]+{_SLIP})*[\s,.;:!…–-]+(?P<rest>.+)$"
)
"""A slip taken back without a pause that is written, or by words that mean nothing else."""
_HESITANT = re.compile(r"[\s,.;:!–-]+(?:oh|ah|no|wait|oops|uh|um)$")
"""Ends what was said before it is taken back."""
_NAMED_LAST = re.compile(
    r"^(?P<said>.+?)[,;.]+ (?P<rest>(?:to |on |in )?(?:the|an?|my|his|her) [\w' ]+?|\w+),? (?:is what )?i (?:mean"
    r"|meant|said"
    r"|wanted to say|meant to say)[\s.!]*$"
)
"""*To the kitchen, the lab I mean*: what was meant comes last."""
_RESUMED = re.compile(
    r"^(?P<said>.+?)\s*(?:\.\.\.+|…)\s*(?P<rest>(?:the|a|an|to|on|in|my|just|two|three|four"
    r"|five|all|both)\b.*)$"
)
_ONLY = re.compile(r"^(?:(?:just|only|simply|rather|well|put it|yes|yeah|make (?:it|that)|i mean)[\s,]+)+(?=\w)")
_NOT_THAT = re.compile(r"^(?:not|wasn't|isn't) (?:the |a |to )?[\w ]{1,30}?(?:[,;.]+| but) *")
_FOR = re.compile(
    r"^(?:(?:it|they|that|this)(?: is|'s| are| was| were| should (?:be|go)| goes?| must go| belongs) )?(?:meant "
    r"|intended )?"
    r"(?:for|to) (?=\w)"
)
"""*It is for Maria*, *for Maria*: to her."""
_IS_THE = re.compile(
    r"^(?:it|that|this|they)(?: is|'s| was| are| were| should be| must be) (?=(?:the|an?|my|all|both)\b)"
)
_MEANT = re.compile(
    rf"^{_COURTESY}(?:actually|rather|make (?:it|that)|(?:i (?:have )?)?changed my mind"
    rf"|on second thoughts?|come to think of it"
    r"|(?:that is|that's|this is) not what i (?:meant|wanted|said|asked for)|my mistake|my bad|i misspoke|correction"
    r"|(?:change|switch|correct) (?:it|that|this) to|(?:i|we) (?:meant|mean|said)(?: to say)?|better)[\s,.:;!]+"
    r"(?P<rest>.+)$"
)
_SORRY = re.compile(
    r"^(?:oh |ah |oops,? )?(?:sorry|oops|wait|hang on|hold on)[\s,.!]+(?P<rest>(?:to|on|in|into|onto|the|my|next"
    rf" to|{'|'.join(COLORS)})\b.*)$"
)
_NOT = re.compile(
    rf"^{_COURTESY}(?:(?:i|we) (?:meant|mean|said|wanted) )?(?P<rest>(?:(?:to|on|in|the) ){{0,2}}\w+(?: \w+)?),?"
    rf" not (?:(?:to|on|in|the) ){{0,2}}\w+(?: \w+)?[\s.!]*$"
)
_INSTEAD = re.compile(
    r"^(?P<rest>.+?)[\s,]+(?:instead|rather|(?:is what )?i (?:meant|mean|said|wanted)(?: to say)?)[\s.!]*$"
)
_AGAIN = re.compile(
    r"^(?:please\s+)?(?:do (?:it|that|the same(?: thing)?)(?: again| once more| one more time)"
    r"|again|once more|one more time|(?:and )?the same again|repeat (?:that|it)|same again)[\s,.!]*(?:please)?["
    r"\s.!]*$"
)
_TOO = re.compile(
    r"^(?:and |also |now |then )+(?!do (?:the )?same)(?P<rest>.+?)(?:[\s,]+(?:too|as well"
    r"|also))?(?:[\s,]+please)?[\s.!?]*$|"
    r"^(?P<rest2>.+?)[\s,]+(?:too|as well)(?:[\s,]+please)?[\s.!?]*$|"
    r"^(?:and |now |then |ok |okay |,|please |can you |could you |also )*(?:do )?(?:the )?"
    r"(?:very |exact )?same (?:thing )?(?:again )?(?:with|for|to) (?P<rest3>.+?)[\s.!?]*$"
    r"|^(?:and )?(?:what|how) about (?P<rest4>.+?)[\s.!?]*$"
)


_AMOUNT = r"\b(?:(?:all|the|just|only)(?: the)? )?(?:one|two|three|four|five|six|seven|eight|both|all|\d+)\b"
_COUNTED = re.compile(rf"^(?P<amount>{_AMOUNT[2:]})(?: of them)?(?P<more>,? (?:to|in|on|into|onto|for|at|next)\b.*|)$")
"""*Two cans, or rather all three, to the counter*: only the number is taken back."""
_COLORED = re.compile(
    rf"^(?:the )?(?P<color>{'|'.join(COLORS)})(?: one)?(?P<more>(?:,? (?:to|in|on|into|onto|for|at|next) .+)?)$"
)
"""*The red cup, sorry, the blue one, to Ben*: only the color is taken back."""
_RENAMED = re.compile(r"^(?:the|my|an?|his|her) (?:\w+ ){1,2}(?P<noun>\w+)$")
"""*The green folder to Victor, correction, the red folder*: the thing of that name is another one."""
_WHERE = frozenset({"to", "on", "onto", "in", "into", "at", "under", "beside", "near", "next", "by", "for"})
"""Words that a remark may stand for."""
_DETERMINERS = frozenset({"the", "a", "an", "my", "our", "your", "his", "her", "their", "this", "that", "these",
                          "those", "all", "both", "every", "each", "some", "any", "another"})  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Revision:
    """A remark about the request before. ``how``: correct, again or too; ``rest``: what is said beside that."""

    how: str
    rest: str = ""


def revision(text: str, settings: DialogueSettings = DialogueSettings()) -> Revision | None:
    """The remark that ``text`` is, if it is one; ``rest`` may still turn out to be a request of its own."""
    said = _THANKED.sub("", " ".join(text.casefold().replace("’", "'").split()))
    if len(said) > settings.remark_characters:
        return None
    if _AGAIN.match(said):
        return Revision(how="again")
    for pattern in (_INSTEAD, _NO, _MEANT, _SORRY, _NOT):
        found = pattern.match(said)
        if found and found["rest"].strip(" .!?"):
            rest = _MADE.sub("", _FORGOTTEN.sub("", _SAID.sub("", _LED.sub("", found["rest"]))))
            rest = _FOR.sub("to ", _NOT_THAT.sub("", _TRAILING.sub("", rest)))
            return Revision(how="correct", rest=_DENIED.sub("", rest).strip(" .!?"))
    found = _TOO.match(said)
    if found:
        return Revision(how="too", rest=next(group for group in found.groups() if group))
    return None


def repair(text: str, settings: DialogueSettings = DialogueSettings()) -> tuple[str, str] | None:
    """What was said and what was meant instead, in one request: *bring me the cup, no sorry, the book*."""
    said = " ".join(text.casefold().replace("’", "'").split())
    found = (
        next(filter(None, (p.match(said) for p in (_BARE, _REPAIR, _NAMED_LAST, _RESUMED))), None)
        if len(said) <= settings.remark_characters
        else None
    )
    if found is None:
        return None
    rest = _NOT_THAT.sub("", _TRAILING.sub("", _ONLY.sub("", _LED.sub("", found["rest"])))).strip(" .!?,")
    return (_HESITANT.sub("", found["said"]).strip(" .,;:-"), rest) if rest else None


def thing_meant(rest: str) -> str:
    """*It's the lab*, said of something to be done: the lab."""
    return _IS_THE.sub("", rest)


def is_place(rest: str) -> bool:
    """Whether a correction tells of nothing but where: *to the office*."""
    return rest.split(maxsplit=1)[0] in _WHERE


def restated(said: str, rest: str, settings: DialogueSettings = DialogueSettings()) -> Iterator[str]:
    """``said`` with its last words replaced by ``rest``, the fewest first; *just* begins anew."""
    words = said.split()
    if rest in NUMBERS or rest.isdecimal():
        yield " ".join(rest if word in NUMBERS or word.isdecimal() else word for word in words)
    colored = _COLORED.match(rest)
    spoken = [word for word in words if word in COLORS]
    if colored and len(spoken) == 1:
        yield " ".join(colored["color"] if word in COLORS else word for word in words) + colored["more"].replace(
            ",", ""
        )
    renamed = _RENAMED.match(rest)
    if renamed:
        same = re.compile(rf"\b(?:the|my|an?|his|her) (?:\w+ ){{0,2}}?{re.escape(renamed['noun'])}\b")
        if len(same.findall(said)) == 1:
            yield same.sub(rest, said)
    if re.search(r" and (?!nothing else)", said) or " then " in said:
        return
    counted = _COUNTED.match(rest)
    if counted:
        yield re.sub(_AMOUNT, counted["amount"], said, count=1) + counted["more"].replace(",", "", 1)
    for kept in range(len(words) - 1, max(len(words) - settings.most_replaced - 1, -1), -1):
        if _sort_of(words[kept]) == _sort_of(rest.split(maxsplit=1)[0]):
            yield " ".join([*words[:kept], rest])


def _sort_of(word: str) -> str:
    """What a phrase is that begins with ``word``: only a place takes the place of a place, a thing of a thing."""
    if word in _WHERE:
        return "place"
    return "thing" if word in _DETERMINERS or word in NUMBERS or word.isdecimal() else "word"


class Reviser:
    """Applies remarks to an earlier request on one graph."""

    def __init__(self, grounding: Grounding, context: Context, settings: DialogueSettings = DialogueSettings()) -> None:
        self._grounding, self._context = grounding, context
        self._snapshot, self._semantics = grounding.snapshot, Semantics(grounding, settings)

    def again(self, earlier: Exchange) -> Meaning:
        """The same goals once more."""
        return self._meant(earlier.goals)

    def by_phrase(self, how: str, phrases: Sequence[NounPhrase], earlier: Exchange) -> Outcome | None:
        """With another object or place in the earlier goals; None when the phrase fits neither."""
        objects = tuple(dict.fromkeys(goal.args[0] for goal in earlier.goals if goal.object_id is not None))
        places = tuple(
            dict.fromkeys(goal.args[-1] for goal in earlier.goals if goal.predicate in PLACING | {Predicate.ROBOT_AT})
        )
        troubles: list[Outcome] = []
        for old in (objects, places if how == "correct" or not objects else ()):
            if len(old) != 1:
                continue
            context = replace(
                self._context, noun=self._noun(old[0]), fresh=(), mentioned=(*old, *self._context.mentioned)
            )
            for phrase in phrases:
                if phrase.words == ("one",) or self._alike(phrase, old[0]):
                    outcome = self._replaced(phrase, old, earlier, context, as_object=old is objects)
                    if isinstance(outcome, Meaning):
                        return outcome
                    troubles.append(outcome)
        return troubles[0] if troubles else None

    def by_place(self, readings: Sequence[Step], earlier: Exchange) -> Outcome | None:
        """With another destination: *no, on the desk*."""
        objects = tuple(dict.fromkeys(goal.args[0] for goal in earlier.goals if goal.predicate in PLACING))
        fitting = tuple(
            reading
            for reading in readings
            if isinstance(reading, Carry) and reading.destination and reading.things == (Pronoun(word="it"),)
        )
        if len(objects) != 1 or not fitting:
            return None
        return self._semantics.of(fitting, replace(self._context, fresh=objects))

    def _replaced(
        self, phrase: NounPhrase, old: tuple[str, ...], earlier: Exchange, context: Context, *, as_object: bool
    ) -> Outcome:
        apart = replace(phrase, other=True) if phrase.words == ("one",) and not phrase.colors else phrase
        found = self._grounding.things(apart, context) if as_object else self._grounding.place(apart, context)
        if not isinstance(found, tuple):
            return found
        goals = [
            self._changed(goal, old[0], new, as_object=as_object)
            for new in found
            for goal in earlier.goals
            if old[0] in goal.args
        ]
        return self._meant(tuple(goals))

    def _changed(self, goal: Goal, old: str, new: str, *, as_object: bool) -> Goal:
        placed = goal.predicate in PLACING and not as_object
        predicate = placing_predicate("to", new, self._grounding) if placed else goal.predicate
        return Goal(predicate=predicate, args=tuple(new if arg == old else arg for arg in goal.args))

    def _alike(self, phrase: NounPhrase, old: str) -> bool:
        """Whether a phrase could stand in the place of ``old``: a thing for a thing, a room for a room or table."""
        fitting = self._grounding.names.named(phrase.head, phrase.number, widely=True)
        return any(self._sort(i) == self._sort(old) for i in fitting)

    def _sort(self, node_id: str) -> str:
        thing = self._grounding.state.world.things.get(node_id)
        return "thing" if thing is not None and thing.graspable else "place"

    def _noun(self, node_id: str) -> str:
        node = self._snapshot.get(node_id)
        if isinstance(node, PersonNode):
            return "person"
        return normal(node.label) if isinstance(node, ObjectNode | RoomNode) else "thing"

    def _meant(self, goals: tuple[Goal, ...]) -> Meaning:
        things = tuple(dict.fromkeys(goal.args[0] for goal in goals if goal.object_id is not None))
        places = tuple(dict.fromkeys(goal.args[-1] for goal in goals if goal.object_id is None or len(goal.args) > 1))
        return Meaning(goals=goals, things=things, places=places)
