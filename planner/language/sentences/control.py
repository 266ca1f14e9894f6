"""Words that act before anything else is thought about: stop, wait, go on, cancel."""

from __future__ import annotations

import re
from collections.abc import Sequence
from enum import StrEnum

from planner.language.sentences.tokens import words_of


class Control(StrEnum):
    """Closed set of control words."""

    STOP = "stop"
    PAUSE = "pause"
    RESUME = "resume"
    CANCEL = "cancel"


_PHRASES: dict[Control, tuple[str, ...]] = {
    Control.STOP: (
        "stop", "halt", "freeze", "emergency stop", "stop now", "stop it", "stop moving", "stop immediately",
        "stop right there", "do not move", "do not move any more", "stand still", "stop there", "stop that",
        "stop what you are doing",
    ),
    Control.PAUSE: ("wait", "pause", "hold on", "hang on", "wait a moment", "wait a second", "wait a minute",
    "one moment",
                    "hold it", "wait there", "wait here", "just a moment", "just a second"),
    Control.RESUME: ("resume", "go on", "continue", "carry on", "proceed", "keep going", "you can go on", "go ahead",
                     "you may continue", "you can continue", "unpause"),
    Control.CANCEL: ("cancel", "abort", "never mind", "nevermind", "forget it", "cancel that", "cancel it",
        "abort it",
                     "cancel the task", "abort the task", "leave it", "cancel the job", "cancel the order",
                     "cancel the request", "cancel the mission", "cancel my request",
                     "cancel everything", "cancel all", "cancel my last request", "abort the mission",
                     "abort mission",
                     "scratch that", "call it off", "leave it be", "cancel this", "forget about it", "drop it",
                     "drop the whole thing", "forget the whole thing", "cancel the whole thing"),
}  # fmt: skip
_COURTESY = frozenset(
    {
        "please",
        "robot",
        "whoa",
        "woah",
        "yo",
        "quick",
        "quickly",
        "sorry",
        "you",
        "can",
        "could",
        "majordomo",
        "butler",
        "now",
        "ok",
        "okay",
        "hey",
        "no",
        "oh",
        "immediately",
    }
)
_CRY = re.compile(
    r"^(?:(?:who+a+|wo+ah+|hey+|oi+|oy+|ho|ow+|ouch|aa+h*|argh+|ah+|oh+|easy(?: (?:there|now"
    r"|on))?|steady(?: on)?|no+(?=[,!.])|hold up"
    r"|(?:oh )?my (?:god|goodness)|careful|look out|watch (?:out|it)|for (?:god|heaven)'?s sake)\b[\s,!.–—-]+)+(?=\w)"
)
"""What people cry before they say what they want."""
_VAGUE = frozenset({"right", "a", "second", "moment", "minute", "sec", "just", "for", "at", "once", "bit",
    "everything",
                    "thanks", "then", "so", "well"})  # fmt: skip
"""Adds nothing after a control word, as in *hold on a second*."""
_JOB = (
    r"(?:(?:the|that|this|my|your|our|what you are doing|whatever you are doing)(?: (?:whole"
    r"|entire|last|current|previous|latest|stupid))* ?"
    r"(?:thing|job|task|request|order|mission|errand|plan|work|idea|instruction|command|trip|business|one)?s?"
    r"|(?:what|whatever|everything|all)(?: that)? (?:i|we) (?:have |just |last )*(?:asked|said"
    r"|wanted|told you|ordered|requested)"
    r"(?: for| you| of you| you to do| before)*)"
)
_LEADS = (
    r"(?:(?:on second thoughts?|actually|no|oh|well|sorry|you can|you may|could you|can you"
    r"|let us|just|wait|please|robot|majordomo|hey|ok|okay|now|quick|alright|all right|right|fine|good|great|yes"
    r"|yeah|so"
    r"|then|and)[\s,]+)*"
)
_ENOUGH = r"(?:(?:that is )?enough(?: (?:now|of (?:that|this|it)))?|(?:quit|cut) it(?: out)?|knock it off)"
_WHILE = (
    r" (?:just )?(?:for )?(?:a|one|two|three|five|ten|a few|a couple of|\d+|half a|another|an other)"
    r" (?:short |little )?(?:second|sec|moment|minute|min|bit|while|mo|tick)s?"
)
_MORE = (
    r"(?: (?:it|that|this|them|one|those|him|her|my|mind|the|mistake|myself|yourself|himself|herself|themselves|already"
    r"|anyway|now|after|all|again|any|more|anymore|longer|on|own|by|in|time|instead|out|home|something|else|up"
    r"|late|here"
    r"|there|wrong|back|with|without|thanks|then))*"
)
_DONE = (
    r"(?:got|gotten|found|have|has|took|taken|brought|did|done|changed|fetched|see|saw|seen|managed|handled|sorted"
    r"|settled|forgot|forgotten|remembered|remember|know|made|picked|put|solved|fixed|arrived|left|came|finished)"
)
_BEING = (
    r"(?:fine|good|ok|okay|all right|alright|late|too late|here|there|gone|busy|wrong|mistaken|going|leaving|enough"
    r"|coming|back|over|solved|sorted|settled|done|home|not (?:needed|necessary|important|urgent))"
)
_WHO_DID = (
    r"(?:i|we|he|she|they|it|that|somebody|someone|somebody else|someone else|(?!(?:please|then|and|to|so|but|now"
    r"|go|come"
    r"|bring|take|put|get|fetch|give|find|move|carry|drop|return|look|hand|pick|place|drive|stay|wait|leave)\b)[a-z]+)"
)
_REASON = re.compile(
    rf"{_WHO_DID}(?: (?:have|has|had|already|just|now|been|actually|finally))* {_DONE}{_MORE}"
    rf"|{_WHO_DID}(?: (?:have|has))?(?: already| just| now)? (?:am|is|are|was|were|been)(?: already| just| now)* "
    rf"{_BEING}{_MORE}"
    rf"|(?:i|we|he|she|they|[a-z]+) (?:will|can|would rather|am going to|is going to|are going to) (?:just )?"
    rf"(?:do|get|fetch|find|bring|take|manage|handle|go|sort|pick up) (?:it|that|them|this|one|by)?{_MORE}"
    rf"|(?:i|we|he|she|they|[a-z]+) (?:do|does|did) not (?:need|want|mean|care){_MORE}|(?:i|we) no longer (?:need"
    rf"|want){_MORE}"
    r"|(?:that is |it is |that was )?(?:the )?(?:wrong|too late)(?: \w+)?"
    r"|(?:watch|look|mind) (?:out|it|your step|where you .*)|(?:be )?careful|danger|all clear|the coast is clear"
    r"|there (?:is|are|was) .*|you (?:are|will|were|have|almost|nearly|just|could|might) .*"
    r"|(?:the|an?|my|our|some)? ?[a-z]+(?: [a-z]+)? (?:is|are) (?:just )?(?:[a-z]+ing|at the door|in the way|here"
    r"|there)\b.*"
    r"|it is (?!for|the|an?|to|in|on|at|my|his|her|not|from)\w+.*|(?:i|we) (?:was|were|am|are) (?:just "
    r")?(?:[a-z]+ing|done|ready)\b.*"
)
"""Why something is called off, which is no request: *I got it myself*, *Ben brought it already*."""
_SHAPES: tuple[tuple[Control, re.Pattern[str]], ...] = tuple(
    (control, re.compile(rf"{_LEADS}(?:{pattern})(?: please| now| robot| for now| thanks?(?: you)?)*"))
    for control, pattern in (
        (
            Control.CANCEL,
            (
                rf"(?:cancel|abort|forget|scrap|scratch|abandon|ditch|call off|never ?mind|disregard|skip"
                rf"|give up on|no need for)"
                rf"(?: about)? (?:it|that|this|everything|all of (?:it|that)|{_JOB})(?: off)?"
            ),
        ),
        (
            Control.CANCEL,
            (
                rf"(?:drop|stop|leave|quit|end|kill|call) (?=(?:[\w ]+ )?(?:task|job|request|order|mission"
                rf"|errand|plan|work)\b){_JOB}(?: off| alone| be)?"
            ),
        ),
        (
            Control.CANCEL,
            (
                r"(?:no longer (?:needed|necessary|required|wanted)|not (?:needed|necessary) (?:any ?more|after all)"
                r"|let it (?:go|be|drop)|(?:you can |you may )?(?:stop|quit|leave off|give up)"
                r" (?:looking|searching|hunting|trying)(?: (?:for (?:it|that|them|him|her)|it))?"
                r"|(?:cancel|abort)(?: (?:please|now|all of it|all this))?)"
            ),
        ),
        (
            Control.CANCEL,
            (
                r"(?:i (?:have )?changed my mind|do not bother(?: with (?:it|that)| any ?more)?|no need(?: (?:to"
                r"|for it|for that"
                r"|any ?more|now))?|do not worry about (?:it|that)|(?:it |that )?does not matter(?: any ?more| "
                r"now)|(?:that is|it is"
                r"|this is) (?:no longer|not) (?:needed|necessary)(?: any ?more)?|(?:you )?(?:do not"
                r"|need not) have to(?: any ?more)?)"
            ),
        ),
        (
            Control.PAUSE,
            (
                rf"(?:(?:take|have) a (?:short |little |quick |brief )?(?:break|rest|breather|pause|time ?out)"
                rf"|pause|wait|hold on|hang on|rest|stop){_WHILE}"
            ),
        ),
        (Control.PAUSE, r"(?:take|have) a (?:short |little |quick |brief )?(?:break|rest|breather|pause|time ?out)"),
        (
            Control.PAUSE,
            (
                r"(?:(?:wait|pause|stay|hold on|hang on|stop)(?: there| here)? (?:till|until) i (?:say|tell|am"
                r"|come|call|give"
                r"|return|let)\b.{0,30}|hold your horses|bear with me|stand by|hang fire|hold fire|time ?out"
                r"|give me (?:a|one"
                r"|just a) (?:sec|second|moment|minute)|(?:just )?(?:wait|hold on|hang on|pause)(?: right"
                r"| just)?"
                r"(?: there| here| up| on| a while| a bit| for a bit| a little| for me| what you are doing| that"
                r"| it)*)"
            ),
        ),
        (
            Control.STOP,
            (
                r"(?:stay|remain|stop|stand|hold)(?: exactly| right| just| there)* where you are(?:[\s,]+"
                r"(?:and )?(?:do not|not) .{0,30})?"
            ),
        ),
        (
            Control.STOP,
            (
                r"(?:do not|not)(?: you)?(?: dare)?(?: move| budge| stir| go| take| drive)? ?(?:an other"
                r"|one|a single|one more|a|any)(?: more)? (?:inch|step|muscle|further|centimeter|millimeter"
                r"|meter|bit|wheel|finger)(?: further| more| closer| forward)?"
            ),
        ),
        (
            Control.STOP,
            (
                r"(?:do not (?:you )?(?:move|budge|stir)(?: a muscle)?|(?:hold|keep|stay|stand|be) (?:still"
                r"|put)|stop (?:dead|in your tracks|driving|right now|this instant|at once|this second"
                r"|everything|all of that|whatever you are doing))"
            ),
        ),
        (
            Control.STOP,
            (
                rf"(?:{_ENOUGH}|(?:stop|halt|freeze)(?: (?:it|that|this|(?:the |that |this )?(?:robot|machine"
                rf"|thing)|everything"
                r"|(?:what|whatever) you are doing|moving|driving|dead|at once|right (?:there|now|away)|there"
                r"|now|immediately"
                r"|this (?:instant|second|minute|moment)|please|everybody|everyone|all|here|right here))+)"
            ),
        ),
        (
            Control.PAUSE,
            (
                r"(?:pause|suspend|interrupt)(?: (?:it|that|this|(?:the|your|that|this|my) (?:\w+ )?"
                r"(?:task|job|work|mission|order|request|errand|trip)|for (?:now|a \w+|the moment)|a \w+))+|take"
                r" (?:five|ten)"
            ),
        ),
        (
            Control.CANCEL,
            (
                r"(?:i|we) (?:do not|no longer) (?:need|want) (?:it|that|them|this|anything)(?: any ?more| now|"
                r" after all"
                r"| at all| done)*|let go of (?:it|that|everything|all of it)(?: you were doing)?|leave it at that"
            ),
        ),
        (
            Control.RESUME,
            (
                r"(?:resume|continue|carry on|proceed|keep (?:going|on|at it|moving)|move on|get on with it"
                r"|unpause|go on"
                r"|go ahead|pick it up again|get going)(?: (?:now|again|then|please|if you like))*"
            ),
        ),
        (
            Control.RESUME,
            (
                r"(?:resume|continue|carry on|go on|go ahead|proceed|keep going|pick up|get on|go back|get back)"
                r"(?: with| to)? ?(?:what you were (?:doing|up to|at)|where you (?:left off|stopped|were"
                r"|paused)|(?:from )?where you (?:left off|stopped)|(?:your|the|that) (?:work|task|job"
                r"|errand|mission|order|request|trip|plan)|as before|as you were|doing what you were doing)"
            ),
        ),
        (
            Control.RESUME,
            (
                r"(?:(?:resume|continue|carry on|proceed|get on with)(?: with)? (?:it|that)|as you were"
                r"|(?:get )?back to (?:it|work|what you were doing|your (?:work|task|job))|(?:go )?on you go|get "
                r"to work|(?:start|get) (?:moving"
                r"|going) again|you may (?:move|go|proceed) (?:again|on|now)|unfreeze|"
                r"(?:ok )?off you go again)"
            ),
        ),
    )
)
"""Wordings of each control, beside the set phrases: a verb of ending with the word for a job, and the like."""
_MEANING = {phrase: control for control, phrases in _PHRASES.items() for phrase in phrases}
MAX_CHARACTERS = 200


def control_word(text: str) -> Control | None:
    """The control that the whole of ``text`` is, courtesy and repetition aside; None for anything else.

    *stop*, *Stop! Stop!*, *please wait* are controls. *stop at the kitchen* is not: it says more than the word does.
    """
    if len(text) > MAX_CHARACTERS:
        return None
    text = _CRY.sub("", text.casefold())
    words = [word.text for word in words_of(text) if word.kind == "word" and word.text not in _COURTESY]
    return _one_control(words) or _one_control([word for word in words if word not in _VAGUE]) or _shaped(text)


def _shaped(text: str) -> Control | None:
    """The control whose shape the whole has, or each of its parts: *I changed my mind, forget the whole thing*."""
    words = [word for word in words_of(text) if word.kind in ("word", "comma", "stop")]
    found = _of_shape(" ".join(word.text for word in words if word.kind == "word"))
    parts: list[list[str]] = [[]]
    for word in words:
        parts = [*parts[:-1], [*parts[-1], word.text]] if word.kind == "word" else [*parts, []]
    said = [part for part in parts if set(part) - _COURTESY]
    controls = {_control_of(part) for part in said if not _is_reason(part)}
    if controls == {Control.STOP, Control.CANCEL}:
        return Control.STOP
    return found or (controls.pop() if len(controls) == 1 else None)


def _control_of(part: Sequence[str]) -> Control | None:
    return _one_control(list(part)) or _of_shape(" ".join(part))


def _is_reason(part: Sequence[str]) -> bool:
    bare = [word for word in part if word not in _COURTESY]
    return _control_of(part) is None and any(_REASON.fullmatch(" ".join(words)) for words in (part, bare))


def _of_shape(said: str) -> Control | None:
    return next((control for control, shape in _SHAPES if shape.fullmatch(said)), None)


def _one_control(words: list[str]) -> Control | None:
    """The control that every part of ``words`` stands for: *stop, stop*, or *drop it, cancel the job*."""
    for length in range(len(words), 0, -1):
        control = _MEANING.get(" ".join(words[:length]))
        if control is not None and (length == len(words) or _one_control(words[length:]) is control):
            return control
    return None
