"""``python -m exactpt``: the command line."""

from exactpt.cli import main

if __name__ == "__main__":
    main()
