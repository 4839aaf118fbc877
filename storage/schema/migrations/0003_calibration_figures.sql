-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 3: the record of a calibration also holds what it promises and how good it was found (form 2
-- of calibration_record.h; records of form 1 stay as they are). A version that knows form 1 only could
-- not read a new one: not compatible with 2.

UPDATE store_info SET compatible_version = 3;
