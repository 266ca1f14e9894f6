"""Rigid transforms and their uncertainty."""
