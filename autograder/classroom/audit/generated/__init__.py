"""Mutation testing: typical mistakes, made automatically in correct submissions; survivors show gaps in the checks."""
