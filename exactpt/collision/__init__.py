"""Contacts: the questions users ask."""
