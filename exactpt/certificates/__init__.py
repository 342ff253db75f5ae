"""Certificates of moving vertices: signs just after now and times of failure. No mesh."""
