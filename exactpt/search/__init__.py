"""Contacts and distances of many bodies: who may meet, when, and the questions of callers."""
