"""What is given: bodies and a time span, and their file format."""
