"""The verbs about programs, and the studies, as functions."""
from ._calls import QUESTIONS, STUDIES, run_verb
from ._combiner import Error, nearest_name
from ._programs import Program, State
from ._results import Explanation, Proof, Report, Vectors


def _chosen(what, name, names):
    if not isinstance(name, str):
        raise TypeError(f"{what} is {type(name).__name__}; expected one of {', '.join(names)}")
    if name.replace("_", "-") not in names:
        raise Error(f"unknown {what} '{name}'; expected one of {', '.join(names)}{nearest_name(name, names)}")
    return name.replace("_", "-")


def study(name, *arguments, progress=None, **options):
    """Runs a study, as `ninebit study NAME`: "index-steps", "datapath", "depth-packing", "shadows" with a scene, or
    "merge" with parts; returns a Report. options("study index-steps") lists the options."""
    name = _chosen("study", name, STUDIES)
    expected = {"shadows": 1, "merge": len(arguments)}.get(name, 0)
    if len(arguments) != expected or (name == "merge" and not arguments):
        needed = {"shadows": "a scene", "merge": "at least one part"}.get(name, "no argument besides the options")
        raise TypeError(f"study {name} was given {len(arguments)} arguments; expected {needed}")
    return Report._of(*run_verb(("study", name), [("scene" if name == "shadows" else "part", value, False) for value in arguments],
                        options, progress))


def prove(question, *arguments, progress=None, **options):
    """Answers a question for all inputs, as `ninebit prove QUESTION`; returns a Proof, which is true if it is proved.

    "equivalent" takes two programs, "stable" one, "discriminate" two profiles or the option field, "kit" none.
    """
    question = _chosen("question", question, QUESTIONS)
    expected = {"equivalent": [2], "stable": [1], "discriminate": [0, 2], "kit": [0]}[question]
    if len(arguments) not in expected:
        raise TypeError(f"prove {question} was given {len(arguments)} arguments; expected "
                        f"{' or '.join(str(count) for count in expected)}")
    programs = question in ("equivalent", "stable")
    if question == "equivalent" and options.get("other_profile") is None:
        first, other = (one.state if isinstance(one, Program) else one for one in arguments)
        if isinstance(other, State) and isinstance(first, State) and other._profile != first._profile:
            options = {**options, "other_profile": other._profile}
    return Proof._of(*run_verb(("prove", question), [("program" if programs else "profile", value, programs) for value in arguments],
                       options, progress))


def explain(program, **options):
    """What a program computes, as `ninebit explain`; returns an Explanation. options("explain") lists the options."""
    return Explanation._of(*run_verb(("explain",), [("program", program, True)], options, None))


def convert(program, to=None, **options):
    """A program as a text of another form, whose names `ninebit help convert` lists. Without `to`, the list of
    set-ups of a log, as a dictionary."""
    answer, _, _ = run_verb(("convert",), [("program", program, True)], {**options, "to": to}, None)
    return answer if to is None else answer["rows"][0].get("text", answer)


def vectors(*, progress=None, **options):
    """A pack of programs, inputs and expected outputs for emulators, as `ninebit vectors`; returns Vectors.

    Without `output`, nothing is written. options("vectors") lists the options."""
    return Vectors._of(*run_verb(("vectors",), [], options, progress))
