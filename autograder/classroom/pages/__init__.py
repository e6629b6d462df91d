"""The pages of a graded class, made from grades and from drawings of what was judged.

One page is on the class, for its instructor. Each submission has two: one for the student, one for the instructor.
"""
