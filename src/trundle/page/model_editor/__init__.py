"""Model editor: an SDF document, its parts and their fields, findings and files."""
