# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the Crevasse authors

"""Reads the results of Crevasse: reports, figures, and settings for an accuracy."""
