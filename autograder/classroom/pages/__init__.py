"""The pages of a graded class, made from the grades and from drawings of the judged runs.

The class has one page, for the instructor. Each submission has two pages, one for the student and one for the
instructor.
"""
