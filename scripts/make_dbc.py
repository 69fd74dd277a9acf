#!/usr/bin/env python3
"""Writes config/anthrob/anthrob_ecu.dbc: the protocol of docs/ecu_protocol.md as a DBC file for CAN tools.

dbc_test of anthrob_driver compares the result with the codec."""
import argparse
import os

FUNCTIONS = ['STOP', 'SYNC', 'REQUEST', 'REFERENCE', 'MOTION_A', 'MOTION_B', 'EFFORT', 'ANALOG', 'STATE',
             'PARAMETER_REQUEST', 'PARAMETER_REPLY', 'HEALTH']
LENGTHS = [0, 4, 7, 8, 8, 8, 8, 8, 8, 8, 8, 8]
MOTION = [('counter', 0, 4, '+', 1, ''), ('state', 4, 3, '+', 1, ''), ('stop_latched', 7, 1, '+', 1, ''),
          ('position', 8, 22, '-', 2.5e-05, 'rad'), ('velocity', 30, 14, '-', 0.0025, 'rad/s'),
          ('current', 44, 12, '-', 0.01, 'A'), ('crc', 56, 8, '+', 1, '')]
PARAMETER = [('code', 0, 4, '+', 1, ''), ('muscle', 4, 4, '+', 1, ''), ('index', 8, 8, '+', 1, ''),
             ('sequence', 16, 8, '+', 1, ''), ('value', 24, 32, '-', 1, ''), ('crc', 56, 8, '+', 1, '')]
SIGNALS = {
    'STOP': [],
    'SYNC': [('counter', 0, 8, '+', 1, ''), ('enabled', 8, 1, '+', 1, ''), ('version', 16, 8, '+', 1, ''),
             ('crc', 24, 8, '+', 1, '')],
    'REQUEST': [('operation', 0, 8, '+', 1, ''), ('sequence', 8, 8, '+', 1, ''), ('session', 16, 8, '+', 1, ''),
                ('configuration', 32, 16, '+', 1, ''), ('crc', 48, 8, '+', 1, '')],
    # Scale of the references: 1e-5 V, rad, A or 1e-4 N, by mode.
    'REFERENCE': [('counter', 0, 4, '+', 1, ''), ('mode_a', 4, 2, '+', 1, ''), ('mode_b', 6, 2, '+', 1, ''),
                  ('reference_a', 8, 24, '-', 1, ''), ('reference_b', 32, 24, '-', 1, ''), ('crc', 56, 8, '+', 1, '')],
    'MOTION_A': MOTION,
    'MOTION_B': MOTION,
    'EFFORT': [('counter', 0, 4, '+', 1, ''), ('force_a', 4, 14, '+', 0.02, 'N'), ('voltage_a', 18, 12, '-', 0.01, 'V'),
               ('force_b', 30, 14, '+', 0.02, 'N'), ('voltage_b', 44, 12, '-', 0.01, 'V'), ('crc', 56, 8, '+', 1, '')],
    'ANALOG': [('counter', 0, 4, '+', 1, '')] + [('count_%d' % i, 4 + 12 * i, 12, '+', 1, '') for i in range(4)]
              + [('crc', 56, 8, '+', 1, '')],
    'STATE': [('state', 0, 3, '+', 1, ''), ('stop_latched', 3, 1, '+', 1, ''), ('refusal', 4, 4, '+', 1, ''),
              ('fault', 8, 7, '+', 1, ''), ('muscle', 15, 1, '+', 1, ''), ('sequence', 16, 8, '+', 1, ''),
              ('session', 24, 8, '+', 1, ''), ('configuration', 32, 16, '+', 1, ''), ('version', 48, 8, '+', 1, ''),
              ('crc', 56, 8, '+', 1, '')],
    'PARAMETER_REQUEST': PARAMETER,
    'PARAMETER_REPLY': PARAMETER,
    'HEALTH': [('temperature_a', 0, 8, '-', 1, 'degC'), ('temperature_b', 8, 8, '-', 1, 'degC'),
               ('supply', 16, 8, '+', 0.1, 'V'), ('transmit_errors', 24, 8, '+', 1, ''),
               ('receive_errors', 32, 8, '+', 1, ''), ('refused_frames', 40, 8, '+', 1, ''), ('crc', 56, 8, '+', 1, '')],
}
FROM_HOST = {'STOP', 'SYNC', 'REQUEST', 'REFERENCE', 'PARAMETER_REQUEST'}
STATES = ['BOOT', 'IDLE', 'ENABLED', 'STOPPING', 'FAULT']
MODES = ['VOLTAGE', 'POSITION', 'CURRENT', 'FORCE']
FAULTS = ['none', 'self_test', 'over_current', 'over_force', 'position_limit', 'over_speed', 'over_temperature',
          'supply_low', 'supply_high', 'force_sensor', 'encoder', 'sync_lost', 'reference_lost', 'bus_off']
REFUSALS = ['accepted', 'stop_latched', 'in_fault', 'not_configured', 'wrong_session', 'no_sync', 'wrong_version',
            'unknown_operation', 'self_test']
OPERATIONS = {1: 'enable', 2: 'disable', 3: 'clear'}
NODES = range(1, 8)


def values(words):
    pairs = words.items() if isinstance(words, dict) else enumerate(words)
    return ' '.join('%d "%s"' % pair for pair in sorted(pairs, reverse=True))


def main():
    out = ['VERSION "1"', '', 'NS_ :', '', 'BS_:', '', 'BU_: HOST ' + ' '.join('ECU_%d' % n for n in NODES), '']
    value_lines = []
    for number, function in enumerate(FUNCTIONS):
        nodes = [0] if function in ('STOP', 'SYNC') else ([0] if function == 'REQUEST' else []) + list(NODES)
        for node in nodes:
            identifier = number << 7 | node
            name = function if node == 0 and function != 'REQUEST' else '%s_%s' % (function, node or 'ALL')
            sender = 'HOST' if function in FROM_HOST else 'ECU_%d' % node
            receiver = 'HOST' if sender != 'HOST' else ('ECU_%d' % node if node else ','.join('ECU_%d' % n for n in NODES))
            out.append('BO_ %d %s: %d %s' % (identifier, name, LENGTHS[number], sender))
            for signal, start, width, sign, scale, unit in SIGNALS[function]:
                low = -scale * 2 ** (width - 1) if sign == '-' else 0
                high = scale * (2 ** (width - 1 if sign == '-' else width) - 1)
                out.append(' SG_ %s : %d|%d@1%s (%s,0) [%.10g|%.10g] "%s" %s'
                           % (signal, start, width, sign, repr(scale), low, high, unit, receiver))
                words = {'state': STATES, 'fault': FAULTS, 'refusal': REFUSALS, 'operation': OPERATIONS,
                         'mode_a': MODES, 'mode_b': MODES}.get(signal)
                if words:
                    value_lines.append('VAL_ %d %s %s ;' % (identifier, signal, values(words)))
            out.append('')
    out += ['CM_ "Motor units of Anthrob, 1 Mbit/s; docs/ecu_protocol.md";', '']
    for node in NODES:
        for function in (9, 10):
            out.append('SIG_VALTYPE_ %d value : 1;' % (function << 7 | node))
    out += [''] + value_lines
    path = os.path.join(os.path.dirname(__file__), '..', 'config', 'anthrob', 'anthrob_ecu.dbc')
    with open(path, 'w') as f:
        f.write('\n'.join(out) + '\n')


if __name__ == '__main__':
    argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter).parse_args()
    main()
