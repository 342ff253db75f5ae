"""Exchange of shapes with files and libraries, as bodies at rest."""
