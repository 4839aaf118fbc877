-- SPDX-FileCopyrightText: 2026 The Relievo authors
-- SPDX-License-Identifier: GPL-3.0-or-later
--
-- Migration 5: the record of a calibration also names the cameras it was made with (form 3 of
-- calibration_record.h; records of forms 1 and 2 stay as they are). A version that knows those only could
-- not read a new one: not compatible with 4.

UPDATE store_info SET compatible_version = 5;
