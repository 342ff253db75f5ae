"""Certificates of moving vertices: signs just after now, and when they may fail. No mesh."""
