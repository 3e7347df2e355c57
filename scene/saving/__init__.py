# SPDX-License-Identifier: GPL-3.0-or-later
"""What leaves Blender: parts as files, the JSON of an object, and that files are there whole or not at all.

- ``export``: parts as files
- ``object_report``: what the JSON says of an object
- ``run_files``: files put in place all or none
- ``file_checks``: whether a file is all there
"""
