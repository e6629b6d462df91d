"""JUnit XML for one submission, as CodeGrade, Submitty, GitLab, Artemis and Jenkins read it.

The format has no official specification; this is the common part of Jenkins' junit-10.xsd and of what these programs
read. A submission without a score is an <error>, which none of them counts as a failed test.
"""

from __future__ import annotations

from xml.etree import ElementTree as Xml

from autograder.classroom.export.published import (
    Options,
    Published,
    printable,
    publish,
    text_without_score,
    why_no_score,
)
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.table import verdict_text

FILE = "junit.xml"


def render(grade: Grade, options: Options) -> str:
    """Return the file for a grade."""
    suite = Xml.Element("testsuite", name=grade.exercise)
    if why_no_score(grade):
        case = _case(suite, grade.exercise, grade.exercise)
        Xml.SubElement(case, "error", message=text_without_score(grade), type=why_no_score(grade))
    else:
        _fill(suite, publish(grade, options.hidden))
    for attribute, tag in (("tests", "testcase"), ("failures", "failure"), ("errors", "error")):
        suite.set(attribute, str(len(list(suite.iter(tag)))))
    suite.set("skipped", "0")
    suites = Xml.Element(
        "testsuites", {key: value for key, value in suite.attrib.items() if key != "skipped"}
    )
    suites.append(suite)
    Xml.indent(suites)
    return Xml.tostring(suites, encoding="unicode", xml_declaration=False).join(
        ('<?xml version="1.0" encoding="UTF-8"?>\n', "\n")
    )


def _fill(suite: Xml.Element, published: Published) -> None:
    properties = Xml.SubElement(suite, "properties")
    for name, value in (("score", published.score), ("max_score", published.max_score)):
        Xml.SubElement(properties, "property", name=name, value=f"{value:g}")
    if published.late:
        Xml.SubElement(properties, "property", name="late", value=published.late)
    for check in published.checks:
        case = _case(suite, published.exercise, check.title)
        if check.points < check.max_points:
            _fail(case, check)
    if published.hidden:
        case = _case(suite, published.exercise, published.hidden_sum)
        if published.hidden_points < published.hidden_max_points:
            Xml.SubElement(case, "failure", message=published.hidden_sum, type="hidden")


def _fail(case: Xml.Element, check: CheckVerdict) -> None:
    message = f"{check.points:g} of {check.max_points:g} points. {check.observed or check.help}".strip()
    failure = Xml.SubElement(case, "failure", message=printable(message), type=check.status)
    failure.text = printable(verdict_text(check))


def _case(suite: Xml.Element, exercise: str, name: str) -> Xml.Element:
    return Xml.SubElement(suite, "testcase", classname=exercise, name=printable(name))
